"""Routes of the server: one page and one JSON document, for readers on this machine alone."""

from __future__ import annotations

import asyncio
import re
from typing import Any

from rgss.errors import RgssError
from rgss.serving.observer import StudyObserver
from rgss.serving.replays import TrialReplays

_MOST_DIGITS = 10
"""Digits of the number of a variant or of a seed in an address."""

HOSTS = ("127.0.0.1", "localhost")
"""Host names that a browser on this machine sends; another one indicates DNS rebinding."""

_HEADERS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
_FRAMES = "frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
_POLICY = "default-src 'none'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
_PAGE_POLICY = (
    "default-src 'none'; connect-src 'self'; style-src 'unsafe-inline'; script-src {scripts}; frame-ancestors 'none'; "
    "base-uri 'none'; form-action 'none'"
)


def study_application(observer: StudyObserver, page: str, replays: TrialReplays) -> Any:
    """The ASGI application.

    Args:
        observer: The observer of the study.
        replays: Replays its trials.
        page: The page with the digests of its scripts.
    """
    from starlette.applications import Starlette
    from starlette.middleware import Middleware
    from starlette.middleware.trustedhost import TrustedHostMiddleware
    from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse
    from starlette.routing import Route

    policy = _PAGE_POLICY.format(scripts=" ".join(re.findall(r"'sha256-[A-Za-z0-9+/=]+'", page)))

    async def show_page(_: Any) -> Any:
        return HTMLResponse(page, headers={**_HEADERS, "Content-Security-Policy": policy})

    async def show_state(request: Any) -> Any:
        state = observer.state(seen=request.query_params.get("seen", ""))
        return JSONResponse(state, headers={**_HEADERS, "Content-Security-Policy": _POLICY})

    async def show_replay(request: Any) -> Any:
        headers = {**_HEADERS, "Content-Security-Policy": _FRAMES}
        # A page from elsewhere must not make this machine run trials.
        if request.headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
            return PlainTextResponse("Only the page of this server opens a replay.", status_code=403, headers=headers)
        variant, seed = request.path_params["variant"], request.path_params["seed"]
        # Python refuses to convert a number of thousands of digits.
        if not all(re.fullmatch(rf"[0-9]{{1,{_MOST_DIGITS}}}", one) for one in (variant, seed)):
            return PlainTextResponse(
                "A replay has the address /replay/VARIANT/SEED, both of them whole numbers.\n",
                status_code=404,
                headers=headers,
            )
        try:
            made = replays.page(int(variant), int(seed))
            return HTMLResponse(await asyncio.shield(asyncio.wrap_future(made)), headers=headers)
        except RgssError as error:
            return PlainTextResponse(f"{error}\n", status_code=404, headers=headers)
        except Exception as error:  # the page says why there is no replay
            problem = f"The replay cannot be made: {type(error).__name__}: {error}\n"
            return PlainTextResponse(problem, status_code=500, headers=headers)

    return Starlette(
        routes=[
            Route("/", show_page, methods=["GET"]),
            Route("/state.json", show_state, methods=["GET"]),
            Route("/replay/{variant}/{seed}", show_replay, methods=["GET"]),
        ],
        middleware=[Middleware(TrustedHostMiddleware, allowed_hosts=list(HOSTS), www_redirect=False)],
    )
