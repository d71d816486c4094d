"""Reading of task files, one module an entry, and the findings about them."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tasks.reading.document import TaskDocument
    from rgss.tasks.reading.scene_findings import task_findings
    from rgss.tasks.reading.task_file import LoadedTask, load_task
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
