"""Regression guard of metrics: statistics, baseline file and report."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.regression.baseline import (
        Baseline,
        BaselineOrigin,
        BaselineRun,
        Change,
        DecisionState,
        baseline_to_text,
        read_baseline,
    )
    from rgss.regression.comparing import WHOLE_TRIAL, Candidate, Comparison, Guard, Outcome, Subject
    from rgss.regression.comparing_baselines import (
        DecisionChanges,
        changed_trials,
        contradictions,
        decision_changes,
        run_failings,
        schema_failings,
        schema_notes,
        unchanged_phases,
    )
    from rgss.regression.input_changes import InputChange, InputKind, Inputs, origin_changes, value_changes
    from rgss.regression.looking import settle
    from rgss.regression.observing import SUCCESS, fingerprint, mean_of, observed
    from rgss.regression.pairing_designs import paired_by_levels
    from rgss.regression.power import MEAN_LOSS, MOST_SEEDS, TARGET, Power, powers
    from rgss.regression.report import Behaviour, ChangedTrial, Failing, FailureCause, RegressionReport
    from rgss.regression.sign_flips import FEWEST_SEEDS, adjusted_p_values
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
