//! The machines of the host.

mod scalar;

pub use scalar::Scalar;
