"""An import-linter contract: a module is imported by its own package; others use the package's front door."""

from __future__ import annotations

import grimp
from importlinter import Contract, ContractCheck, output


class FrontDoorContract(Contract):
    """Modules are imported from within their package alone; other code imports from the package.

    A module of ``rgss.sweep.dask`` may be imported by modules below ``rgss.sweep.dask``; all others, those of
    ``rgss.sweep`` too, import what ``rgss.sweep.dask`` exports. Modules of the root package are free.
    """

    type_name = "front_door"

    def check(self, graph: grimp.ImportGraph, verbose: bool) -> ContractCheck:
        """Find the imports that pass a front door by."""
        roots = self.session_options["root_packages"]
        passing_by: list[tuple[str, str]] = []
        for module in sorted(graph.modules):
            package = module.rpartition(".")[0]
            if module.partition(".")[0] not in roots or package in {"", *roots} or graph.find_children(module):
                continue
            importers = sorted(graph.find_modules_that_directly_import(module))
            passing_by += [
                (importer, module)
                for importer in importers
                if importer != package and not importer.startswith(f"{package}.")
            ]
        return ContractCheck(kept=not passing_by, metadata={"passing_by": passing_by})

    def render_broken_contract(self, check: ContractCheck) -> None:
        """Print a line for each import."""
        for importer, module in check.metadata["passing_by"]:
            output.print_error(f"{importer} imports {module}; export the name from {module.rpartition('.')[0]}")
