"""A value that the checking library refuses is answered in this project's words, with the limit that was written here."""

from typing import Annotated, Any, Literal

import pytest
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from quartering.hull.file.refusals import allowed, user_words

pytestmark = pytest.mark.quick


class _Keys(BaseModel):
    model_config = ConfigDict(allow_inf_nan=False)
    length: float


@pytest.mark.parametrize(
    ("kind", "given", "words"),
    [
        (Annotated[float, Field(gt=0)], 0, "above 0"),
        (Annotated[float, Field(ge=-360)], -400, "from -360"),
        (Annotated[float, Field(lt=2)], 2, "below 2"),
        (Annotated[float, Field(le=1 / 7)], 1, "up to 0.1429"),
        (float, "long", "a number"),
        (float, None, "a number"),
        (int, "many", "a whole number"),
        (int, 1.5, "a whole number"),
        (int, [], "a whole number"),
        (bool, "perhaps", "true or false"),
        (bool, None, "true or false"),
        (str, 5, "text (in quotes when it looks like a number)"),
        (Annotated[str, Field(max_length=2)], "abc", "up to 2 letters"),
        (list[float], 3, "a list, such as [0, 1.5, 2.0]"),
        (Annotated[list[float], Field(min_length=2)], [1], "a list of 2 or more"),
        (Annotated[list[float], Field(max_length=1)], [1, 2], "a list of up to 1"),
        (Literal["stf", "bem", "own"], "x", "'stf', 'bem', 'own'"),
        (Literal[1, 3, 5], 2, "1, 3, 5"),
        (dict[str, float], 3, "a group of keys"),
        (_Keys, 3, "a group of keys"),
    ],
)
def test_each_kind_of_refusal_has_our_words(kind: Any, given: Any, words: str):
    with pytest.raises(ValidationError) as refused:
        TypeAdapter(kind).validate_python(given)
    assert allowed(refused.value.errors()[0]) == words
    assert user_words(refused.value.errors()[0]) is None


def test_what_is_not_finite_is_said():
    with pytest.raises(ValidationError) as refused:
        _Keys(length=float("nan"))
    assert allowed(refused.value.errors()[0]) == "a finite number"


def test_a_kind_nobody_foresaw_is_still_said_in_our_words():
    assert allowed({"type": "of_another_release", "msg": "Input should be novel"}) == "a value of another kind"
