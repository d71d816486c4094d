"""Registry of the rules of wording: those of every module of this package, by their ids."""

from __future__ import annotations

import importlib
import pkgutil
import re
from pathlib import Path

from rgss.trace.rules.rule import Rule


def _found() -> tuple[Rule, ...]:
    """Import the other modules of this package and collect their ``RULES``, without a registry."""
    package, _, own = __name__.rpartition(".")
    names = sorted(module.name for module in pkgutil.iter_modules([str(Path(__file__).parent)]) if module.name != own)
    rules = [rule for name in names for rule in importlib.import_module(f"{package}.{name}").RULES]
    return tuple(sorted(rules, key=_by_number))


def _by_number(rule: Rule) -> tuple[bool, int, str]:
    """Order of the listing: the numbers of the INCOSE guide, then names."""
    number = re.fullmatch(r"wording\.R(\d+)", rule.id)
    return number is None, int(number[1]) if number else 0, rule.id


WORDING_RULES: tuple[Rule, ...] = _found()
