"""Running mean and standard deviation: independent of the split into batches."""

import numpy as np

from rsoccer.train.rollout.running_mean_std import RunningMeanStd


def test_batches_give_the_mean_and_deviation_of_all_data() -> None:
    data = np.random.default_rng(0).normal(3.0, [1.0, 20.0, 0.5], (1000, 3))
    rms = RunningMeanStd(3)
    for batch in np.split(data, [1, 10, 11, 500]):
        rms.update(batch)
    rms.update(data[:0])
    np.testing.assert_allclose(rms.mean, data.mean(0), rtol=1e-12)
    np.testing.assert_allclose(rms.std, data.std(0), rtol=1e-12)


def test_a_constant_column_keeps_a_usable_deviation() -> None:
    rms = RunningMeanStd(2)
    rms.update(np.ones((50, 2)))
    assert (rms.std == 1e-2).all()


def test_the_state_can_be_restored() -> None:
    data = np.random.default_rng(1).normal(size=(60, 4))
    whole, first, second = RunningMeanStd(4), RunningMeanStd(4), RunningMeanStd(4)
    whole.update(data[:20])
    whole.update(data[20:])
    first.update(data[:20])
    second.load_state_dict(first.state_dict())
    second.update(data[20:])
    assert second.count == 60
    assert second.mean.tobytes() == whole.mean.tobytes()
    assert second.variance.tobytes() == whole.variance.tobytes()
