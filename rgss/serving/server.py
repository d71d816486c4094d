"""HTTP server on the loopback interface, which ends at a signal."""

from __future__ import annotations

import importlib.util
import os
import signal
import socket
from collections.abc import Callable
from typing import Any

from rgss.errors import DefinitionError

ADDRESS = "127.0.0.1"
HIGHEST_PORT = 65535
_CLOSING_S = 2


def require_server() -> None:
    """Make sure that the packages of the extra ``serve`` are installed.

    Raises:
        DefinitionError: One is missing.
    """
    missing = [name for name in ("starlette", "uvicorn") if importlib.util.find_spec(name) is None]
    if missing:
        raise DefinitionError(
            f"rgss serve needs {' and '.join(missing)}, which is not installed", hint="pip install 'rgss[serve]'"
        )


def listen(port: int) -> socket.socket:
    """A socket on the loopback that takes connections.

    Args:
        port: The port; 0 for any that is free.

    Raises:
        DefinitionError: The port is impossible, or in use, or may not be used.
    """
    if not 0 <= port <= HIGHEST_PORT:
        raise DefinitionError(f"--port must be from 0 to {HIGHEST_PORT}, got {port}", hint="0 takes any free port")
    found = socket.socket()
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        found.bind((ADDRESS, port))
        found.listen()
    except OSError as error:
        found.close()
        reason = os.strerror(error.errno or 0)
        raise DefinitionError(
            f"port {port} of {ADDRESS} cannot be used: {reason}", hint="--port 0 takes any free port"
        ) from error
    return found


def serve(application: Any, listening: socket.socket, *, ready: Callable[[], None]) -> None:
    """Serve until SIGINT or SIGTERM.

    Args:
        application: The ASGI application.
        listening: A socket that takes connections, which is closed in the end.
        ready: Called as soon as a signal would end the server cleanly.
    """
    import uvicorn

    server = uvicorn.Server(
        uvicorn.Config(
            application,
            http="h11",
            loop="asyncio",
            ws="none",
            lifespan="off",
            log_config=None,
            log_level="error",
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=_CLOSING_S,
        )
    )

    def end(*_: object) -> None:
        server.should_exit = True

    # The server's own handlers hand the signal on to these when it has ended.
    before = {each: signal.signal(each, end) for each in (signal.SIGINT, signal.SIGTERM)}
    try:
        ready()
        server.run(sockets=[listening])
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)
        listening.close()
