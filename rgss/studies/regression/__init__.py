"""The ``regression`` section of a study: watched trials, guarded metrics, margins."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.regression.document import RegressionEntry
    from rgss.studies.regression.guard import GuardedMetric, RegressionGuard, WatchedRun
    from rgss.studies.regression.reader import read_regression
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
