"""Routes of the server: one page and one JSON document, for readers on this machine alone."""

from __future__ import annotations

import re
from typing import Any

from rgss.serving.observer import StudyObserver

HOSTS = ("127.0.0.1", "localhost")
"""Names by which a browser on this machine calls it; another name is that of a page that has been rebound to it."""

_HEADERS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
_POLICY = "default-src 'none'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
_PAGE_POLICY = (
    "default-src 'none'; connect-src 'self'; style-src 'unsafe-inline'; script-src {scripts}; frame-ancestors 'none'; "
    "base-uri 'none'; form-action 'none'"
)


def study_application(observer: StudyObserver, page: str) -> Any:
    """The ASGI application.

    Args:
        observer: Observes the study.
        page: The page, which names the digests of its scripts.
    """
    from starlette.applications import Starlette
    from starlette.middleware import Middleware
    from starlette.middleware.trustedhost import TrustedHostMiddleware
    from starlette.responses import HTMLResponse, JSONResponse
    from starlette.routing import Route

    policy = _PAGE_POLICY.format(scripts=" ".join(re.findall(r"'sha256-[A-Za-z0-9+/=]+'", page)))

    async def show_page(_: Any) -> Any:
        return HTMLResponse(page, headers={**_HEADERS, "Content-Security-Policy": policy})

    async def show_state(request: Any) -> Any:
        seen = request.query_params.get("seen", "")
        state = observer.state(seen=int(seen) if seen.isdecimal() and len(seen) < 10 else -1)
        return JSONResponse(state, headers={**_HEADERS, "Content-Security-Policy": _POLICY})

    return Starlette(
        routes=[Route("/", show_page, methods=["GET"]), Route("/state.json", show_state, methods=["GET"])],
        middleware=[Middleware(TrustedHostMiddleware, allowed_hosts=list(HOSTS), www_redirect=False)],
    )
