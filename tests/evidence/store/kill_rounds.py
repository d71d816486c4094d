"""Kills a process that writes to a store, again and again at random instants; run as a program.

The interpreter is started and forked once for all rounds, so that a round takes milliseconds. Each
writer goes on where the store ends and says through a pipe what it has put. Prints what it saw as JSON.
"""

from __future__ import annotations

import json
import os
import random
import signal
import sys
import time
from dataclasses import replace
from pathlib import Path

from rgss.evidence import EvidenceStore, Piece, PieceKind, Provenance, record_from_json, text_digest, trial_key
from rgss.evidence.store.verification import verify

PIECES = 3


def batch(number: int, record):
    """What one transaction puts: a trial, pieces of some size, and its inputs."""
    inputs = {"number": number, "ballast": "x" * (number % 7) * 300}
    digests = {str(part): text_digest(f"piece {number} {part}") for part in range(PIECES)}
    pieces = [
        Piece(digest=digest, kind=PieceKind.PLAN, text=json.dumps([number, "y" * 400 * int(part)]))
        for part, digest in digests.items()
    ]
    provenance = Provenance(
        inputs=digests,
        versions={},
        inputs_digest=text_digest(json.dumps(inputs, sort_keys=True, separators=(",", ":"))),
    )
    return (trial_key({"trial": number}), record(number), provenance), pieces, inputs


def write(path: Path, record, said: int, last: int) -> None:
    """Put batch after batch, beginning with the first that is not there."""
    with EvidenceStore.open(path) as store:
        for number in range(len(store), last):
            trial, pieces, inputs = batch(number, record)
            store.put_many(trials=[trial], pieces=pieces, inputs=[inputs])
            os.write(said, f"{number}\n".encode())


def killed_after(path: Path, record, after: int, delay_s: float) -> list[int]:
    """Let a process write, kill it a while after it has said so many times that it put something."""
    read_end, write_end = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(read_end)
        write(path, record, write_end, last=10**9)
        os._exit(0)
    os.close(write_end)
    with os.fdopen(read_end) as pipe:
        said = [int(pipe.readline()) for _ in range(after)]
        time.sleep(delay_s)
        os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
        assert status == signal.SIGKILL
        return said + [int(line) for line in pipe]


def main(path: Path, text: str, rounds: int, seed: int) -> None:
    """Run the rounds, finish undisturbed, and compare with a store that was never disturbed."""
    template = record_from_json(text)

    def record(number: int):
        return replace(template, variant=number)

    choose = random.Random(seed)  # noqa: S311
    put, wrong = 0, []
    for number in range(rounds):
        # Without waiting, the kill falls into the opening of the store as often as into a write.
        after = choose.randrange(4)
        said = killed_after(path, record, after, choose.uniform(0.0, 0.005 if after else 0.02))
        put = max([put, *(one + 1 for one in said)])
        if not path.exists():
            continue
        with EvidenceStore.open(path) as store:
            there = len(store)
            pieces = store.has_pieces(
                text_digest(f"piece {one} {part}") for one in range(there + 1) for part in range(PIECES)
            )
        # What was said is there; the batch in hand is there as a whole or not at all.
        if there not in (put, put + 1) or len(pieces) != there * PIECES:
            wrong.append(f"round {number}: {put} said, {there} trials, {len(pieces)} pieces")
        put = there
    last = put + 5
    reader, writer = os.pipe()
    write(path, record, writer, last)
    os.close(reader)
    os.close(writer)
    undisturbed = path.with_name("undisturbed.sqlite")
    with EvidenceStore.open(undisturbed) as store:
        batches = [batch(number, record) for number in range(last)]
        store.put_many(
            trials=[trial for trial, _, _ in batches],
            pieces=[piece for _, pieces, _ in batches for piece in pieces],
            inputs=[inputs for _, _, inputs in batches],
        )
    with EvidenceStore.open(path) as one, EvidenceStore.open(undisturbed) as other:
        same = one.all() == other.all()
    found = verify(path, label="store")
    sys.stdout.write(
        json.dumps(
            {
                "put": put,
                "wrong": wrong,
                "same": same,
                "damages": [str(damage) for damage in found.damages],
                "sound": dict(found.sound),
            }
        )
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
