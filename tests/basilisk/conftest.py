"""Flights run two at a time while the tests wait for theirs; what they found is said at the end."""

from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor

import pytest

import flights
import random_specs

TALLY = pytest.StashKey[flights.Tally]()
RANDOM = 60


def pytest_configure(config: pytest.Config) -> None:
    config.stash[TALLY] = flights.Tally()


def pytest_terminal_summary(terminalreporter, config: pytest.Config) -> None:
    tally = config.stash[TALLY]
    for line in tally.lines() if tally.vehicles else []:
        terminalreporter.write_line(line)


@pytest.fixture(scope="session")
def flown(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory):
    """By test, the flight that it is about: of a spec with some settings, or of the random vehicle of a seed."""
    folder = tmp_path_factory.mktemp("flights")
    random_specs.write(folder / "random", RANDOM, 1)
    waiting: dict[str, Future[flights.Flight]] = {}
    with ThreadPoolExecutor(2) as pool:
        for item in request.session.items:
            match getattr(item, "callspec", None) and item.callspec.params.get("flight"):
                case int(seed):
                    future = pool.submit(random_specs.fly, folder / "random" / f"vehicle_{seed}.yaml")
                case spec, settings:
                    future = pool.submit(flights.fly, flights.ROOT / spec, folder / spec, *settings)
                case _:
                    continue
            waiting[item.nodeid] = future
        yield waiting
        pool.shutdown(cancel_futures=True)


@pytest.fixture
def flight(request: pytest.FixtureRequest, flown: dict[str, Future[flights.Flight]]) -> flights.Flight:
    flight = flown[request.node.nodeid].result()
    request.config.stash[TALLY].add(request.node.callspec.id, flight)
    return flight
