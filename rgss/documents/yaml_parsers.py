"""Documents that PyYAML's two parsers read alike: libyaml, which is ten times faster, and its own one in Python."""

from __future__ import annotations

import re
from typing import Any

import yaml

READ_ALIKE_NOT = re.compile("[\t\x85\u2028\u2029]|[|>][-+0-9]{0,2}#")
"""Signs after which PyYAML's two parsers may disagree: libyaml takes tabs between tokens, and a comment that touches
the head of a block scalar."""

EMPTY_IN_FLOW = re.compile(r":\s*[,}\]#]")
"""Possible omitted value of a flow mapping, which the two parsers locate differently."""


def composed(text: str) -> Any:
    """The root node of a text that the reader of documents accepts, with the places of PyYAML's own parser.

    libyaml rejects some of these texts, such as ``{a:, b: 1}``.

    Args:
        text: The text of a file.
    """
    fast = getattr(yaml, "CSafeLoader", None)
    if fast is not None and not READ_ALIKE_NOT.search(text) and not EMPTY_IN_FLOW.search(text):
        try:
            return yaml.compose(text, Loader=fast)
        except yaml.MarkedYAMLError:
            pass
    return yaml.compose(text, Loader=yaml.SafeLoader)
