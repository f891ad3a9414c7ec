//! Whether another library of the process answers to the same names.

/// The shared library of this process, other than the one this crate is part of, that defines one
/// of the symbols of this crate, where there is one: whose routine a call reaches is then for the
/// dynamic linker to say, and neither is what its caller asked for. Linux with GNU's or musl's
/// linker is asked; elsewhere the answer is always `None`.
///
/// Libraries that were loaded for themselves alone (`RTLD_LOCAL`, as Python loads its extensions)
/// are out of the way and not found.
///
/// ```
/// assert_eq!(dense_lapack::other_library(), None);
/// ```
///
/// # References
///
/// dlsym(3), "RTLD_DEFAULT" and "RTLD_NEXT".
#[must_use]
pub fn other_library() -> Option<String> {
    search::other_library()
}

#[cfg(all(target_os = "linux", not(miri)))]
mod search {
    use std::ffi::{CStr, c_char, c_int, c_void};
    use std::ptr;

    use crate::{blas, factor, spectral};

    /// What `dladdr` says of an address.
    #[repr(C)]
    struct Place {
        file: *const c_char,
        base: *mut c_void,
        symbol: *const c_char,
        address: *mut c_void,
    }

    unsafe extern "C" {
        fn dlsym(handle: *mut c_void, symbol: *const c_char) -> *mut c_void;
        fn dladdr(address: *const c_void, place: *mut Place) -> c_int;
    }

    /// The first definition in the order of loading.
    const DEFAULT: *mut c_void = ptr::null_mut();
    /// The first one after the object that asks.
    const NEXT: *mut c_void = ptr::without_provenance_mut(usize::MAX);

    pub(super) fn other_library() -> Option<String> {
        // One of each kind: a library of products alone, or of factorisations alone, has some.
        let ours: [(&CStr, *const c_void); 4] = [
            (c"dgemm_", blas::dgemm_ as *const c_void),
            (c"dpotrf_", factor::dpotrf_ as *const c_void),
            (c"dsyevr_", spectral::dsyevr_ as *const c_void),
            (c"dgesdd_", spectral::dgesdd_ as *const c_void),
        ];
        let home = ours.iter().find_map(|(_, ours)| base(*ours))?.0;
        ours.into_iter().flat_map(|(name, _)| [(name, DEFAULT), (name, NEXT)]).find_map(
            |(name, handle)| {
                // SAFETY: one of the two pseudo-handles, and a name that ends with a zero.
                let found = unsafe { dlsym(handle, name.as_ptr()) };
                let (at, file) = base(found)?;
                (at != home).then_some(file)
            },
        )
    }

    /// Where the object with this address begins, and its file.
    fn base(address: *const c_void) -> Option<(usize, String)> {
        let mut place = Place {
            file: ptr::null(),
            base: ptr::null_mut(),
            symbol: ptr::null(),
            address: ptr::null_mut(),
        };
        // SAFETY: `place` lives as long as the call, and any address may be asked for.
        let known = !address.is_null() && unsafe { dladdr(address, &raw mut place) } != 0;
        if !known || place.file.is_null() {
            return None;
        }
        // SAFETY: a text of the dynamic linker that lives as long as the object is loaded.
        let file = unsafe { CStr::from_ptr(place.file) };
        Some((place.base.addr(), file.to_string_lossy().into_owned()))
    }
}

#[cfg(not(all(target_os = "linux", not(miri))))]
mod search {
    pub(super) fn other_library() -> Option<String> {
        None
    }
}
