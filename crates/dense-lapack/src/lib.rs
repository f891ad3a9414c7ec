//! The dense BLAS and LAPACK routines that a semidefinite cone needs, without a BLAS to install.
//!
//! ```
//! use std::ffi::{c_char, c_int};
//! // [4 2; 2 5] = L Lᵀ with L = [2 0; 1 2], column by column.
//! let mut matrix = [4.0, 2.0, 2.0, 5.0];
//! let (lower, two, mut info): (c_char, c_int, c_int) = (b'L' as c_char, 2, -1);
//! // SAFETY: a matrix of 2 × 2 numbers, and places that live as long as the call.
//! unsafe {
//!     dense_lapack::factor::dpotrf_(&raw const lower, &two, matrix.as_mut_ptr(), &two, &mut info);
//! }
//! assert_eq!(info, 0);
//! assert_eq!([matrix[0], matrix[1], matrix[3]], [2.0, 1.0, 2.0]);
//! ```
//!
//! The cone solver clarabel leaves the dense algebra of its semidefinite cone to whatever BLAS and
//! LAPACK the final binary is linked with, and calls 22 Fortran symbols. This crate defines exactly
//! these, over nalgebra, so that a machine with nothing but the Rust toolchain can link it:
//!
//! | routine | symbols | what it does | module |
//! |---|---|---|---|
//! | gemm | `dgemm_` `sgemm_` | C ← α op(A) op(B) + β C | [`blas`] |
//! | gemv | `dgemv_` `sgemv_` | y ← α op(A) x + β y | [`blas`] |
//! | symv | `dsymv_` `ssymv_` | y ← α A x + β y, A symmetric | [`blas`] |
//! | syrk | `dsyrk_` `ssyrk_` | C ← α A Aᵀ + β C, one triangle | [`blas`] |
//! | syr2k | `dsyr2k_` `ssyr2k_` | C ← α (A Bᵀ + B Aᵀ) + β C, one triangle | [`blas`] |
//! | potrf | `dpotrf_` `spotrf_` | Cholesky factor | [`factor`] |
//! | potrs | `dpotrs_` `spotrs_` | solve with the Cholesky factor | [`factor`] |
//! | gesv | `dgesv_` `sgesv_` | solve by LU with partial pivoting | [`factor`] |
//! | syevr | `dsyevr_` `ssyevr_` | eigenvalues and vectors, symmetric | [`spectral`] |
//! | gesdd | `dgesdd_` `sgesdd_` | singular value decomposition | [`spectral`] |
//! | gesvd | `dgesvd_` `sgesvd_` | singular value decomposition | [`spectral`] |
//!
//! # Use
//!
//! ```
//! use dense_lapack as _; // nothing is called by name: the linker does the rest
//! ```
//!
//! in the crate that depends on clarabel with the features `sdp`, `blas-src` and `lapack-src`, none
//! of which brings a library along. A program that is linked with another BLAS as well has every
//! symbol twice: leave this crate out there. Clarabel calls the routines by Fortran's names, so
//! they cannot have names of their own; where a shared library with the same names is loaded,
//! [`other_library`] says which, for whoever calls clarabel to refuse. A static one beside this is
//! for the linker to refuse, and it does not always. The trick needs a linker that lets clarabel's
//! unused `cdylib` keep undefined symbols, which that of Linux does.
//!
//! # What is left out
//!
//! Matrices are column-major and at most `i32` in size, as in Fortran. The singular value
//! decompositions compute thin factors or none (`'S'`, `'N'`). Anything else is answered by `info =
//! -k`, argument k being illegal. The level-2 and level-3 routines have no `info`; like the
//! reference implementation they say what was wrong and stop the program. An input that is not
//! finite is answered by `info > 0` (not converged).
//!
//! # Safety
//!
//! All `unsafe` of the workspace is here, and all of it is one step: the raw arguments of a call
//! become values, copies of matrices, and the places of the results (module `raw`); what follows is
//! safe code. The caller keeps the BLAS contract: every pointer is valid, arrays are as long as
//! their dimensions say, and an output overlaps nothing else.
//!
//! # References
//!
//! L. S. Blackford et al., ACM Trans. Math. Softw. 28 (2002) 135-151, doi:10.1145/567806.567807
//! (BLAS). E. Anderson et al., LAPACK Users' Guide, 3rd ed., SIAM 1999,
//! doi:10.1137/1.9780898719604.

pub mod blas;
pub mod factor;
mod jacobi;
mod others;
mod raw;
pub mod spectral;

pub use others::other_library;
