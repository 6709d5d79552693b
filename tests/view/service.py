"""What the tests of the service ask it again and again."""

import json
import urllib.error
import urllib.parse
import urllib.request


def ask(explorer, path, content=None, query=None):
    """Status and answer."""
    address = f"{explorer.address}{path}" + (f"?{urllib.parse.urlencode(query, doseq=True)}" if query else "")
    data = None if content is None else content if isinstance(content, bytes) else json.dumps(content).encode()
    request = urllib.request.Request(address, data, {"content-type": "application/json"})
    try:
        with urllib.request.urlopen(request, timeout=600) as answer:
            return answer.status, json.load(answer)
    except urllib.error.HTTPError as error:
        with error:
            return error.code, json.loads(error.read())
