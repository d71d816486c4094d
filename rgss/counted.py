"""Numbers of things in messages, with the noun in singular or plural."""

from __future__ import annotations


def counted(number: int, noun: str) -> str:
    """Number with its noun, such as "1 joint" and "2 joints".

    Args:
        number: The number.
        noun: The noun in singular; its plural has an s.
    """
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
