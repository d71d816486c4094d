"""The workers of a sweep on a Dask cluster."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.sweep.dask.cluster import DaskCluster, dask_cluster
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
