//! Named situations, shared by tests, benchmarks and examples.
