"""Requirement sentences read as text: conditions, terms, comparisons and quantities."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trace.sentences.bounds import bound_of, is_in_trailing_condition
    from rgss.trace.sentences.comparison_phrases import BOUND_PHRASES
    from rgss.trace.sentences.quantities import TextQuantity, quantities_in
    from rgss.trace.sentences.sentences import Sentence, read_sentence, response_start, words_of
    from rgss.trace.sentences.terms import Match, TermList, is_literal, listed, phrases
    from rgss.trace.sentences.units import is_unit
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
