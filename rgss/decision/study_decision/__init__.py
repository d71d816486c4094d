"""Decision of a study as one value, which text, Markdown, JSON and HTML render."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.decision.study_decision.comparison import SideBySide
    from rgss.decision.study_decision.conclusion import Conclusion, DesignStanding, Feasibility
    from rgss.decision.study_decision.contenders import Contender
    from rgss.decision.study_decision.deciding import decide_study
    from rgss.decision.study_decision.equations import EquationVerification
    from rgss.decision.study_decision.findings import RobustnessFindings
    from rgss.decision.study_decision.limit_moves import LimitMove, LimitMoves
    from rgss.decision.study_decision.reasons import ClosestLimit
    from rgss.decision.study_decision.study_decision import StudyDecision, is_settled
    from rgss.decision.study_decision.substitutions import DecidingSubstitution, deciding_substitutions
    from rgss.decision.study_decision.suppositions import WhatIf
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
