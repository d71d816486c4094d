"""Lists of words and phrases that a rule looks for in a sentence."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

from rgss.trace.sentences import Sentence, Token, words_of


@dataclass(frozen=True, slots=True, kw_only=True)
class Match:
    """A term in a sentence.

    Attributes:
        term: The term.
        first: Index of its first word among the tokens of the sentence.
        after: Index of the word behind it.
    """

    term: str
    first: int
    after: int


class TermList:
    """Terms by their first word, so that a sentence without any of them is passed over at once.

    A term is found as whole words with nothing but a space, or the full stop of an abbreviation,
    between them: ``all`` is in neither ``allow`` nor ``all-terrain``, and ``it`` is not in ``IT``.
    A term in capitals is found in capitals only.
    """

    def __init__(self, terms: Iterable[str], *, added: Iterable[str] = ()) -> None:
        """Take the terms.

        Args:
            terms: The rule's own terms.
            added: Those that a project adds.
        """
        self.added = frozenset(added)
        self.terms = tuple(dict.fromkeys((*terms, *added)))
        self._by_first: dict[str, list[tuple[str, tuple[str, ...]]]] = {}
        for term in self.terms:
            words = words_of(term)
            if words:
                self._by_first.setdefault(words[0], []).append((term, words))
        for entries in self._by_first.values():
            # The longest first: "as far as possible" and not "as far as".
            entries.sort(key=lambda entry: -len(entry[1]))
        self._firsts = frozenset(self._by_first)

    def is_absent(self, sentence: Sentence) -> bool:
        """Tell, at little cost, that a sentence has none of the terms; False leaves it open."""
        return self._firsts.isdisjoint(sentence.words)

    def find(self, sentence: Sentence, *, start: int = 0) -> Iterator[Match]:
        """The terms in a sentence, from the word at or behind a place in its text."""
        if self.is_absent(sentence):
            return
        tokens = sentence.tokens
        index = 0
        while index < len(tokens):
            token = tokens[index]
            match = None
            if token.start >= start and token.word in self._firsts:
                match = self._match_at(sentence, index)
            if match is not None:
                yield match
            index = index + 1 if match is None else match.after

    def _match_at(self, sentence: Sentence, index: int) -> Match | None:
        tokens = sentence.tokens
        for term, words in self._by_first[tokens[index].word]:
            after = index + len(words)
            if tuple(token.word for token in tokens[index:after]) == words and _adjoining(
                sentence.text, tokens[index:after]
            ):
                return Match(term=term, first=index, after=after)
        return None


def _adjoining(text: str, tokens: tuple[Token, ...]) -> bool:
    return all(text[one.end : other.start] in (" ", ".") for one, other in pairwise(tokens))
