"""Requests that no page of the server makes: each has an answer, and none runs a trial."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from starlette.testclient import TestClient

from rgss.serving import study_application


@pytest.fixture
def client():
    observer = SimpleNamespace(state=lambda seen: {"seen": seen})
    replays = SimpleNamespace(page=lambda *_: pytest.fail("a trial would be run"))
    return TestClient(study_application(observer, "<p>page</p>", replays), base_url="http://127.0.0.1")


@pytest.mark.parametrize("trial", [f"{'9' * 5000}/1", "1/1e3", "-1/1", "1/\u0661", "1/ 1"])
def test_an_address_without_whole_numbers_has_no_replay(client, trial):
    answer = client.get(f"/replay/{trial}")
    assert answer.status_code == 404
    assert answer.text == "A replay has the address /replay/VARIANT/SEED, both of them whole numbers.\n"


def test_only_pages_that_exist_are_read(client):
    assert client.head("/").status_code == 200
    assert [client.request(verb, "/").status_code for verb in ("POST", "PUT", "DELETE")] == [405, 405, 405]
    assert [client.get(path).status_code for path in ("/../etc/passwd", "/%2e%2e/x", "/replay/1", "/replay/1/1/1")] == [
        404
    ] * 4
    assert client.get("/", headers={"host": "example.org"}).status_code == 400
    assert client.get("/state.json", params={"seen": "x" * 3000}).json() == {"seen": "x" * 3000}
