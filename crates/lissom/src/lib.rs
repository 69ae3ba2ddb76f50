//! Flexible multibody dynamics: facade.
