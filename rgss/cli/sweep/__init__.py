"""Back ends, progress and results of ``rgss sweep``."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.cli.sweep.backend import execution_backend, jobs_of
    from rgss.cli.sweep.output import dry_run_as_json, dry_run_lines, result_as_json, result_lines
    from rgss.cli.sweep.runner import FinishedSweep, SweepRunner, report_lost
    from rgss.cli.sweep.until_decided import sweep_until_decided
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
