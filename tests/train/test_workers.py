"""Threads that share jobs: all are done once, errors arrive, parts cover the rows."""

import threading
from functools import partial

import pytest

from rsoccer.train.workers import Workers, shards


@pytest.mark.parametrize("threads", [1, 2, 5])
@pytest.mark.parametrize("jobs", [0, 1, 3, 40])
def test_each_job_is_done_once_by_a_thread_of_the_workers(threads: int, jobs: int) -> None:
    workers = Workers(threads)
    for _ in range(3):
        done: list[int] = []
        by: list[int] = []

        def job(index: int, thread: int, done: list[int] = done, by: list[int] = by) -> None:
            done.append(index)
            by.append(thread)

        workers.run([partial(job, index) for index in range(jobs)])
        assert sorted(done) == list(range(jobs))
        assert set(by) <= set(range(threads))


def test_jobs_run_at_the_same_time() -> None:
    together = threading.Barrier(2, timeout=10.0)

    def meet(_: int) -> None:
        together.wait()

    Workers(2).run([meet] * 2)
    assert not together.broken


@pytest.mark.parametrize("threads", [1, 2])
def test_an_error_of_a_job_is_raised_when_all_threads_have_stopped(threads: int) -> None:
    def fail(_: int) -> None:
        raise ValueError("a job")

    workers = Workers(threads)
    with pytest.raises(ValueError, match="a job"):
        workers.run([fail] * 6)
    done: list[int] = []
    workers.run([done.append] * 6)
    assert len(done) == 6


def test_a_thread_that_has_not_begun_is_not_waited_for() -> None:
    workers, freed = Workers(2), threading.Event()
    assert workers._executor is not None
    busy = workers._executor.submit(freed.wait, 10.0)
    done: list[int] = []
    workers.run([done.append] * 6)
    assert done == [0] * 6 and not busy.done()
    freed.set()
    assert busy.result()


def test_an_only_part_may_have_fewer_rows_than_others() -> None:
    assert [len(shards(rows, 1024, 256)) for rows in (256, 257, 2048, 2049)] == [1, 2, 2, 4]


@pytest.mark.parametrize("rows", [1, 2, 7, 1024, 1025, 6144])
def test_parts_cover_all_rows_and_are_nearly_equal(rows: int) -> None:
    parts = shards(rows, 1024)
    assert [i for part in parts for i in range(part.start, part.stop)] == list(range(rows))
    sizes = {part.stop - part.start for part in parts}
    assert max(sizes) <= 1024 and max(sizes) - min(sizes) <= 1
    assert len(parts) == 1 or len(parts) % 2 == 0
