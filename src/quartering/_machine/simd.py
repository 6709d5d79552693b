"""Vectors of eight numbers in compiled kernels: one operation works on eight lanes, whatever the processor's own width.

A kernel that is written for one condition in numbers is the kernel for eight in these vectors: `load` takes eight neighbours of
the last axis of an array, `store` puts them back, and between them they stay in registers. Loops over lanes leave that to the
compiler, which must prove that arrays do not overlap before it may, and asks so again at every loop; where the loops are short
that takes longer than the work. Multiply-add is done in one rounding where the processor has it. No lane feels its neighbours.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call, misc"
from __future__ import annotations

import operator
from typing import Any, Final

from llvmlite import ir
from numba import extending
from numba.core import cgutils, types
from numba.core.errors import TypingError
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import lower_builtin, models, register_model

LANES: Final = 8
"""Numbers in a vector: two of a processor with 256 bits; arrays hold a multiple of them in their last axis."""

intrinsic: Any = extending.intrinsic  # its annotations are those of the function it decorates

_DOUBLE = ir.DoubleType()
_VECTOR = ir.VectorType(_DOUBLE, LANES)
_FUSED = ("contract",)


class VectorType(types.Type):
    """Numba's type of such a vector."""

    def __init__(self) -> None:
        super().__init__(name=f"vector{LANES}")


vector_type = VectorType()


@register_model(VectorType)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager: Any, own: Any) -> None:
        super().__init__(manager, own, _VECTOR)


def _all_lanes(builder: Any, number: Any) -> Any:
    """One number in every lane."""
    empty = ir.Constant(_VECTOR, ir.Undefined)
    first = builder.insert_element(empty, number, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(first, empty, ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES))


def _binary(function: Any, name: str) -> None:
    """Teach numba an operation of two vectors, or of a vector and a number."""

    class Template(ConcreteTemplate):
        cases = [  # noqa: RUF012
            signature(vector_type, vector_type, vector_type),
            signature(vector_type, vector_type, types.float64),
            signature(vector_type, types.float64, vector_type),
        ]

    infer_global(function)(Template)

    def lowered(_context: Any, builder: Any, sig: Any, args: Any) -> Any:
        sides = [a if t == vector_type else _all_lanes(builder, a) for a, t in zip(args, sig.args, strict=True)]
        return getattr(builder, name)(*sides, flags=_FUSED)

    for case in Template.cases:
        lower_builtin(function, *case.args)(lowered)


for _function, _name in (
    (operator.add, "fadd"), (operator.iadd, "fadd"), (operator.sub, "fsub"), (operator.isub, "fsub"),
    (operator.mul, "fmul"), (operator.imul, "fmul"), (operator.truediv, "fdiv"),
):  # fmt: skip
    _binary(_function, _name)


@infer_global(operator.neg)
class _Negative(ConcreteTemplate):
    cases = [signature(vector_type, vector_type)]  # noqa: RUF012


@lower_builtin(operator.neg, vector_type)
def _lower_negative(_context, builder, _sig, args):
    return builder.fneg(args[0])


def _address(context, builder, array_type, array, place_type, place):
    """Where the vector at the leading indices stands: the last axis has `LANES` elements, so its stride is a constant."""
    own = context.make_array(array_type)(context, builder, array)
    index = ir.Constant(ir.IntType(64), 0)
    shape = cgutils.unpack_tuple(builder, own.shape, array_type.ndim)
    if isinstance(place_type, types.Integer):
        place, place_type = [place], [place_type]
    else:
        place = cgutils.unpack_tuple(builder, place)
    for axis, (one, of) in enumerate(zip(place, place_type, strict=True)):
        index = builder.mul(index, shape[axis]) if axis else index
        index = builder.add(index, context.cast(builder, one, of, types.int64))
    offset = builder.mul(index, ir.Constant(ir.IntType(64), LANES))
    return builder.bitcast(builder.gep(own.data, [offset], inbounds=True), _VECTOR.as_pointer())


def _row_major(array: Any) -> None:
    """Refuse, as the kernel is compiled, an array whose elements do not follow each other."""
    if array.layout != "C":
        raise TypingError(f"vectors are loaded from row-major arrays; this one is {array}")


@intrinsic
def load(_typing, array, place):
    """The vector at the leading indices of an array whose last axis has `LANES` elements."""

    def lowered(context, builder, sig, args):
        pointer = _address(context, builder, sig.args[0], args[0], sig.args[1], args[1])
        return builder.load(pointer, align=8)

    _row_major(array)
    return vector_type(array, place), lowered


@intrinsic
def store(_typing, array, place, value):
    """Put a vector there."""

    def lowered(context, builder, sig, args):
        pointer = _address(context, builder, sig.args[0], args[0], sig.args[1], args[1])
        builder.store(args[2], pointer, align=8)
        return context.get_dummy_value()

    _row_major(array)
    return types.none(array, place, value), lowered


@intrinsic
def every(_typing, number):  # noqa: ARG001
    """One number in all lanes."""

    def lowered(_context, builder, _sig, args):
        return _all_lanes(builder, args[0])

    return vector_type(types.float64), lowered


@intrinsic
def pick(_typing, array, places):
    """The elements of a flat array at the places that the lanes hold, whole numbers that are in it."""

    def lowered(context, builder, sig, args):
        own = context.make_array(sig.args[0])(context, builder, args[0])
        whole = builder.fptosi(args[1], ir.VectorType(ir.IntType(32), LANES))
        picked = ir.Constant(_VECTOR, ir.Undefined)
        for lane in range(LANES):
            here = ir.Constant(ir.IntType(32), lane)
            element = builder.load(builder.gep(own.data, [builder.extract_element(whole, here)], inbounds=True))
            picked = builder.insert_element(picked, element, here)
        return picked

    _row_major(array)
    return vector_type(array, places), lowered


def _unary(name: str) -> Any:
    @intrinsic
    def function(_typing, a):  # noqa: ARG001
        def lowered(_context, builder, _sig, args):
            made = cgutils.get_or_insert_function(
                builder.module, ir.FunctionType(_VECTOR, [_VECTOR]), f"llvm.{name}.v{LANES}f64"
            )
            return builder.call(made, [args[0]])

        return vector_type(vector_type), lowered

    return function


size = _unary("fabs")
root = _unary("sqrt")


@intrinsic
def where_less(_typing, a, b, yes, no):
    """``yes`` in the lanes where a < b, else ``no``."""

    def lowered(_context, builder, sig, args):
        x, y, p, q = (v if t == vector_type else _all_lanes(builder, v) for v, t in zip(args, sig.args, strict=True))
        return builder.select(builder.fcmp_ordered("<", x, y), p, q)

    def number(t):
        return t if t == vector_type else types.float64

    return vector_type(number(a), number(b), number(yes), number(no)), lowered


@intrinsic
def all_at_most(_typing, a, number):  # noqa: ARG001
    """Is no lane above a number, and none of them not a number?"""

    def lowered(_context, builder, _sig, args):
        inside = builder.fcmp_ordered("<=", args[0], _all_lanes(builder, args[1]))
        bits = ir.IntType(LANES)
        return builder.icmp_unsigned("==", builder.bitcast(inside, bits), ir.Constant(bits, 2**LANES - 1))

    return types.boolean(a, types.float64), lowered
