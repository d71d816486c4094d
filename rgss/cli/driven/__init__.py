"""``rgss run --driver``: the planned task on a simulated or real robot."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.cli.driven.driver_options import add_driver, check_driver
    from rgss.cli.driven.running import run_driven
    from rgss.cli.driven.timed_task import timed_task
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
