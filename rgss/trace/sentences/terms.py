"""Lists of words and phrases that a rule looks for in a sentence."""

from __future__ import annotations

import re
from bisect import bisect_left
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
# Words as tokens have them, also with the full stops of an abbreviation.
_WORDS = re.compile(r"[^\W_]+(?:['’.\-][^\W_]+)*\.?")


class TermList:
    """Terms by their first word, so that a sentence without any of them is passed over at once.

    A term is found as whole words with nothing but a space, or the full stop of an abbreviation,
    between them: ``all`` is in neither ``allow`` nor ``all-terrain``. Capitals do not count, except
    that a term in capitals is found in capitals only, and that ``it`` is not in ``IT``. Hyphens and
    spaces between words are the same: ``user-friendly`` is in ``user friendly``. A ``*`` is any word.

    A term that a project adds is found letter by letter if it has a capital, or a character other than
    letters, digits, hyphens and apostrophes, such as ``(``; without a capital in any capitals.
    """

    def __init__(self, terms: Iterable[str], *, added: Iterable[str] = ()) -> None:
        """Take the terms.

        Args:
            terms: The rule's own terms.
            added: Those that a project adds.
        """
        self.added = frozenset(added)
        self.terms = tuple(dict.fromkeys((*terms, *added)))
        self._literals = [(term, _literal(term)) for term in dict.fromkeys(added) if is_literal(term)]
        literals = {term for term, _ in self._literals}
        self._by_first: dict[str, list[tuple[str, tuple[str, ...]]]] = {}
        for term in (each for each in self.terms if each not in literals):
            for words in _spellings(term):
                self._by_first.setdefault(words[0], []).append((term, words))
        for entries in self._by_first.values():
            # The longest first: "as far as possible" and not "as far as"; what is named before what is any word.
            entries.sort(key=lambda entry: (-len(entry[1]), _ANY_WORD in entry[1]))
        self._firsts = frozenset(self._by_first)

    def is_absent(self, sentence: Sentence) -> bool:
        """Cheap test: True if a sentence has none of the terms; False if it may have one."""
        return self._firsts.isdisjoint(sentence.words) and not any(
            pattern.search(sentence.text) for _, pattern in self._literals
        )

    def find(self, sentence: Sentence, *, start: int = 0) -> Iterator[Match]:
        """The terms in a sentence, from the word at or behind a place in its text."""
        if self.is_absent(sentence):
            return
        if not self._literals:
            yield from self._words(sentence, start)
            return
        found = [*self._words(sentence, start), *self._verbatim(sentence, start)]
        yield from sorted(found, key=lambda match: match.first)

    def _words(self, sentence: Sentence, start: int) -> Iterator[Match]:
        tokens = sentence.tokens
        index = 0
        while index < len(tokens):
            match = self._match_at(sentence, index) if tokens[index].start >= start else None
            if match is not None:
                yield match
            index = index + 1 if match is None else match.after

    def _verbatim(self, sentence: Sentence, start: int) -> Iterator[Match]:
        """Literal terms; one without a word counts with the word behind it, or before it at the end."""
        tokens = sentence.tokens
        for term, pattern in self._literals if tokens else ():
            for found in pattern.finditer(sentence.text, start):
                first = min(bisect_left(tokens, found.start() + 1, key=lambda token: token.end), len(tokens) - 1)
                after = bisect_left(tokens, found.end(), key=lambda token: token.start)
                yield Match(term=term, first=first, after=max(after, first + 1))

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


def is_literal(term: str) -> bool:
    """True if a term that a project adds is found as it is written: not words in small letters or in capitals."""
    parts = [part for part in term.split() if part != _ANY_WORD]
    # Tokens keep the capitals of a word that is all in capitals, and has more than one letter.
    has_capital = any(part != part.lower() and not (part.isupper() and len(part) > 1) for part in parts)
    return has_capital or any(_WORDS.fullmatch(part) is None for part in parts)


def _literal(term: str) -> re.Pattern[str]:
    text = r"\s+".join(r"[\w'’-]+" if part == _ANY_WORD else re.escape(part) for part in term.split())
    before, after = (r"(?<!\w)" if term[0].isalnum() else ""), (r"(?!\w)" if term[-1].isalnum() else "")
    return re.compile(f"{before}{text}{after}", re.IGNORECASE if term == term.lower() else 0)


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
