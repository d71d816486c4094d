"""Lists of words and phrases that a rule looks for in a sentence."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

from rgss.trace.sentences.sentences import Sentence, Token, words_of


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


# In capitals these are abbreviations, operators of logic, or names of modes, and not the words.
_NOT_IN_CAPITALS = frozenset(words_of("it us he or and nor as am may safe fast slow stable"))
_ANY_WORD = "*"


class TermList:
    """Terms by their first word, so that a sentence without any of them is passed over at once.

    A term is found as whole words with nothing but a space, or the full stop of an abbreviation,
    between them: ``all`` is in neither ``allow`` nor ``all-terrain``. Capitals do not count, except
    that a term in capitals is found in capitals only, and that ``it`` is not in ``IT``. Hyphens and
    spaces between words are the same: ``user-friendly`` is in ``user friendly``. A ``*`` is any word.
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
            for words in _spellings(term):
                self._by_first.setdefault(words[0], []).append((term, words))
        for entries in self._by_first.values():
            # The longest first: "as far as possible" and not "as far as"; what is named before what is any word.
            entries.sort(key=lambda entry: (-len(entry[1]), _ANY_WORD in entry[1]))
        self._firsts = frozenset(self._by_first)

    def is_absent(self, sentence: Sentence) -> bool:
        """Cheap test: True if a sentence has none of the terms; False if it may have one."""
        return self._firsts.isdisjoint(sentence.words)

    def find(self, sentence: Sentence, *, start: int = 0) -> Iterator[Match]:
        """The terms in a sentence, from the word at or behind a place in its text."""
        if self.is_absent(sentence):
            return
        tokens = sentence.tokens
        index = 0
        while index < len(tokens):
            match = self._match_at(sentence, index) if tokens[index].start >= start else None
            if match is not None:
                yield match
            index = index + 1 if match is None else match.after

    def _match_at(self, sentence: Sentence, index: int) -> Match | None:
        tokens = sentence.tokens
        said = tokens[index].word
        entries = self._by_first.get(said) or (self._by_first.get(said.lower()) if said.isupper() else None)
        for term, words in entries or ():
            after = index + len(words)
            here = tokens[index:after]
            if (
                len(here) == len(words)
                and all(map(_is_word, here, words))
                and not (len(words) == 1 and said != words[0] and words[0] in _NOT_IN_CAPITALS)
                and _adjoining(sentence.text, here)
            ):
                name = sentence.text[here[0].start : here[-1].end].lower() if _ANY_WORD in words else term
                return Match(term=name, first=index, after=after)
        return self._hyphenated(said.lower(), index) if "-" in said else None

    def _hyphenated(self, said: str, index: int) -> Match | None:
        """Phrase with a ``*`` that is written as one word with hyphens, such as ``easy-to-use``."""
        parts = said.split("-")
        for _, words in self._by_first.get(parts[0], ()):
            spelt = zip(parts, words, strict=True) if _ANY_WORD in words and len(words) == len(parts) else ()
            if spelt and all(word in (part, _ANY_WORD) for part, word in spelt):
                return Match(term=said, first=index, after=index + 1)
        return None


def phrases(text: str) -> tuple[str, ...]:
    """Words and phrases of a list in which commas separate them; line breaks are spaces."""
    return tuple(" ".join(phrase.split()) for phrase in text.split(","))


def listed(matches: Iterable[Match]) -> str:
    """The found terms as a message lists them, each once."""
    return ", ".join(f"'{term}'" for term in dict.fromkeys(match.term for match in matches))


def _spellings(term: str) -> Iterator[tuple[str, ...]]:
    """The words of a term, also with spaces for its hyphens and with hyphens for its spaces."""
    words = tuple(word for part in term.split() for word in ((part,) if part == _ANY_WORD else words_of(part)))
    if not words:
        return
    divided = tuple(word for each in words for word in each.split("-"))
    joined = ("-".join(words),) if _ANY_WORD not in words else words
    yield from dict.fromkeys((words, divided, joined))


def _is_word(token: Token, word: str) -> bool:
    return word in (token.word, _ANY_WORD) or (token.word.isupper() and token.word.lower() == word)


def _adjoining(text: str, tokens: tuple[Token, ...]) -> bool:
    return all(text[one.end : other.start] in (" ", ".") for one, other in pairwise(tokens))
