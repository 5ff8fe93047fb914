//! The fields of the states that are made of numbers alone; the others stand beside their types.

use super::stored;
use crate::identifier::{Cascade, Coefficients, UnitChain};
use crate::moments::InputMoments;
use crate::observer::{Gains, Model};

stored!(Cascade { x1, x2, x3, x4, x5, x6 });
stored!(Coefficients { b1, b2, b3, g, slope });
stored!(UnitChain { u1, u2, u3 });
stored!(InputMoments { j1, j2 });
stored!(Gains { m1, t_l2 });
stored!(Model { k_t2, c_t2 });
