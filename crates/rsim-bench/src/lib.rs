//! Nothing: what measures is in `benches`.
