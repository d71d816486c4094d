"""``rgss serve``: the page of a study while its sweep runs."""

from __future__ import annotations

import argparse

from rgss.cli.options import add_evidence_choice, chosen_project

HELP = "show a study in the browser while its sweep runs: progress, verdicts, the decision so far"
EXAMPLE = "rgss serve --port 0"
MORE_EXAMPLES = (("rgss serve", "on port 8765 of this machine; Ctrl-C ends it"),)
DEFAULT_PORT = 8765


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_evidence_choice(parser)
    parser.add_argument(
        "--port",
        type=int,
        default=DEFAULT_PORT,
        metavar="N",
        help=f"the port on 127.0.0.1; 0 for any that is free (default: {DEFAULT_PORT})",
    )


def run(options: argparse.Namespace) -> int:
    """Serve until Ctrl-C or SIGTERM, which is a clean end."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import shown_path
    from rgss.reports.live import live_page_to_html
    from rgss.serving import StudyObserver, TrialReplays, listen, require_server, serve, study_application

    require_server()
    project = chosen_project(options)
    observer = StudyObserver(
        project.folder,
        lambda: chosen_project(options),
        evidence=project.evidence,
        label=shown_path(project.evidence),
    )
    page = live_page_to_html(project.study.id)
    listening = listen(options.port)
    host, port = listening.getsockname()
    replays = TrialReplays(observer.project)
    app = study_application(observer, page, replays)
    observer.start()
    try:
        serve(app, listening, ready=lambda: _print_address(options, f"http://{host}:{port}/"))
    finally:
        observer.end()
        replays.end()
    return CLEAN


def _print_address(options: argparse.Namespace, address: str) -> None:
    import json

    print(json.dumps({"address": address}) if options.json else address, flush=True)
