"""Decision programs and their orderings: additive, lexicographic, Tchebycheff, minimax regret."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.programs.additive import AdditiveValue
    from rgss.tradeoff.programs.certificate import Certificate, certify
    from rgss.tradeoff.programs.columns import condition_column, keeps, single_values
    from rgss.tradeoff.programs.enumeration import Enumeration, enumerate_alternatives, unknown_evidence, violations
    from rgss.tradeoff.programs.lexicographic import Aim, EpsilonConstraint, Lexicographic
    from rgss.tradeoff.programs.minimax_regret import MinimaxRegret, Scenarios
    from rgss.tradeoff.programs.preferences import Preferences, Program, check_preferences
    from rgss.tradeoff.programs.problem import TradeProblem
    from rgss.tradeoff.programs.program_orderings import ordering_of, orderings_of, weighted_values
    from rgss.tradeoff.programs.tchebycheff import Tchebycheff
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
