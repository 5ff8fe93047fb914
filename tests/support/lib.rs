//! Shared by the tests of this package: seeded motions, tolerances.
