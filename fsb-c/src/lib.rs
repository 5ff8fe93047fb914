//! The C interface of [`fsb_core`]: `libfsb.a` and `fsb-c/include/fsb.h`.
//!
//! The header is the documentation for a user of it. Types and functions carry their C names here, as cbindgen copies them.
//! C has no generics: `axis`, `translation` and `rotation` are the same thin functions for one, three pooled and three
//! separate axes; what they do is in `object` and `estimator`.
//!
//! | file | what |
//! |---|---|
//! | `object` | caller-owned storage, and every check on a pointer |
//! | `status` | status codes and their names |
//! | `names` | names as C texts |
//! | `config` | what the configurations have in common, and the names of their parameters |
//! | `estimator` | what can be done with an estimator of any shape |
//! | `readings` | what any of them hands out |
//! | `values` | what goes in and out |
//! | `axis`, `translation`, `rotation` | the C functions of the three estimators |
//! | `vehicle` | the C functions of the estimator in six degrees of freedom |
//! | `tracking` | the C functions of the controller, and (11) |
//! | `panic` | the panic handler on the microcontroller |

#![cfg_attr(target_os = "none", no_std)]
#![deny(missing_docs)]
#![allow(non_camel_case_types, reason = "the types carry the names of the C interface")]
#![allow(clippy::missing_safety_doc, reason = "one contract for all functions: the rules at the top of fsb.h")]

pub mod axis;
pub mod config;
mod estimator;
mod names;
mod object;
#[cfg(target_os = "none")]
mod panic;
mod readings;
pub mod rotation;
pub mod status;
pub mod tracking;
pub mod translation;
pub mod values;
pub mod vehicle;
pub mod version;
