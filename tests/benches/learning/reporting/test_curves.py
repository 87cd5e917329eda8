from benches.learning.reporting.curves import seconds_to


def test_the_time_to_a_value_is_that_of_the_mean_curve() -> None:
    curves = [
        {"samples": [10, 20, 30], "seconds": [1.0, 2.0, 3.0], "values": [0.9, 0.4, 0.6]},
        {"samples": [20, 30, 40], "seconds": [4.0, 6.0, 9.0], "values": [0.5, 0.7, 0.9]},
        {"samples": [20, 30, 40], "seconds": [4.0, 7.0, 9.0], "values": [0.5, 0.5, 0.6]},
    ]
    assert seconds_to(curves, 0.45) == 4.0
    assert seconds_to(curves, 0.6) == 6.0
    assert seconds_to(curves, 0.8) is None
    assert seconds_to([], 0.0) is None
