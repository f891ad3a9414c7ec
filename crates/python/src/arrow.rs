//! Tables by the Arrow C stream interface
//! (<https://arrow.apache.org/docs/format/CStreamInterface.html>), in a capsule as the PyCapsule
//! interface wants it: polars, pyarrow, pandas and others read them without any of these being
//! there to write them.
//!
//! The structs and their release callbacks are those of the specification, which is C: hence the
//! unsafe code of this file. A table is one batch of columns of doubles, 64-bit integers or text,
//! without nulls.

#![expect(unsafe_code, reason = "the interface is one of C")]

use std::ffi::{CString, c_char, c_int, c_void};
use std::ptr;

use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::raise::internal;

/// `struct ArrowSchema`.
#[repr(C)]
struct Schema {
    format: *const c_char,
    name: *const c_char,
    metadata: *const c_char,
    flags: i64,
    n_children: i64,
    children: *mut *mut Schema,
    dictionary: *mut Schema,
    release: Option<unsafe extern "C" fn(*mut Schema)>,
    private_data: *mut c_void,
}

/// `struct ArrowArray`.
#[repr(C)]
struct Array {
    length: i64,
    null_count: i64,
    offset: i64,
    n_buffers: i64,
    n_children: i64,
    buffers: *mut *const c_void,
    children: *mut *mut Array,
    dictionary: *mut Array,
    release: Option<unsafe extern "C" fn(*mut Array)>,
    private_data: *mut c_void,
}

/// `struct ArrowArrayStream`.
#[repr(C)]
struct Stream {
    get_schema: Option<unsafe extern "C" fn(*mut Stream, *mut Schema) -> c_int>,
    get_next: Option<unsafe extern "C" fn(*mut Stream, *mut Array) -> c_int>,
    get_last_error: Option<unsafe extern "C" fn(*mut Stream) -> *const c_char>,
    release: Option<unsafe extern "C" fn(*mut Stream)>,
    private_data: *mut c_void,
}

/// A number of things in memory, of which there are fewer than 2^63.
fn count(things: usize) -> i64 {
    i64::try_from(things).unwrap_or(i64::MAX)
}

/// The values of a column.
#[derive(Clone)]
enum Values {
    Doubles(Vec<f64>),
    Integers(Vec<i64>),
    /// The ends of the texts, with a zero before them, and their bytes one after another.
    Texts(Vec<i64>, Vec<u8>),
}

impl Values {
    /// The format string of the specification; texts have 64-bit offsets.
    fn format(&self) -> &'static str {
        match self {
            Self::Doubles(_) => "g",
            Self::Integers(_) => "l",
            Self::Texts(..) => "U",
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::Doubles(values) => values.len(),
            Self::Integers(values) => values.len(),
            Self::Texts(ends, _) => ends.len() - 1,
        }
    }

    /// A column of the same kind without rows.
    fn emptied(&self) -> Self {
        match self {
            Self::Doubles(_) => Self::Doubles(vec![]),
            Self::Integers(_) => Self::Integers(vec![]),
            Self::Texts(..) => Self::Texts(vec![0], vec![]),
        }
    }

    /// Validity (there is none), then the data.
    fn buffers(&self) -> Vec<*const c_void> {
        match self {
            Self::Doubles(values) => vec![ptr::null(), values.as_ptr().cast()],
            Self::Integers(values) => vec![ptr::null(), values.as_ptr().cast()],
            Self::Texts(ends, bytes) => {
                vec![ptr::null(), ends.as_ptr().cast(), bytes.as_ptr().cast()]
            }
        }
    }
}

/// What a stream still has to give.
struct Table {
    names: Vec<CString>,
    columns: Vec<Values>,
    rows: usize,
    given: bool,
}

/// What a schema owns.
struct SchemaOwner {
    format: CString,
    name: CString,
    children: Vec<*mut Schema>,
}

fn schema(format: &str, name: CString, children: Vec<Schema>) -> Schema {
    let n_children = count(children.len());
    let children = boxed(children);
    // The formats are literals without zeros.
    let format = CString::new(format).unwrap_or_default();
    let mut owner = Box::new(SchemaOwner { format, name, children });
    Schema {
        format: owner.format.as_ptr(),
        name: owner.name.as_ptr(),
        metadata: ptr::null(),
        flags: 0,
        n_children,
        children: owner.children.as_mut_ptr(),
        dictionary: ptr::null_mut(),
        release: Some(release::<Schema>),
        private_data: Box::into_raw(owner).cast(),
    }
}

/// A struct of the interface that owns children of its own kind.
trait Node: Sized {
    /// What `private_data` points to.
    type Owner;

    /// Where the release callback and the owner stand.
    fn slots(&mut self) -> (&mut Option<unsafe extern "C" fn(*mut Self)>, &mut *mut c_void);

    /// The children, which nobody but the owner frees.
    fn children(owner: Self::Owner) -> Vec<*mut Self>;
}

impl Node for Schema {
    type Owner = SchemaOwner;

    fn slots(&mut self) -> (&mut Option<unsafe extern "C" fn(*mut Self)>, &mut *mut c_void) {
        (&mut self.release, &mut self.private_data)
    }

    fn children(owner: SchemaOwner) -> Vec<*mut Self> {
        owner.children
    }
}

impl Node for Array {
    type Owner = ArrayOwner;

    fn slots(&mut self) -> (&mut Option<unsafe extern "C" fn(*mut Self)>, &mut *mut c_void) {
        (&mut self.release, &mut self.private_data)
    }

    fn children(owner: ArrayOwner) -> Vec<*mut Self> {
        owner.children
    }
}

/// Children in memory of their own.
fn boxed<T: Node>(children: Vec<T>) -> Vec<*mut T> {
    children.into_iter().map(|child| Box::into_raw(Box::new(child))).collect()
}

/// Frees what [`schema`] or [`array`] made, children that nobody has taken included.
///
/// # Safety
/// `of` is null or a struct of this file that was not released.
unsafe extern "C" fn release<T: Node>(of: *mut T) {
    // SAFETY: as promised by the caller; the owner was made by `Box::into_raw` in `schema` or
    // `array`, the children in `boxed`.
    unsafe {
        let Some(of) = of.as_mut() else { return };
        let (callback, private_data) = of.slots();
        if private_data.is_null() {
            return;
        }
        for child in T::children(*Box::from_raw(private_data.cast::<T::Owner>())) {
            // Null where a consumer has moved the child out.
            if let Some(release) = *(*child).slots().0 {
                release(child);
            }
            drop(Box::from_raw(child));
        }
        (*callback, *private_data) = (None, ptr::null_mut());
    }
}

/// What an array owns.
struct ArrayOwner {
    _values: Option<Values>,
    buffers: Vec<*const c_void>,
    children: Vec<*mut Array>,
}

fn array(rows: usize, values: Option<Values>, children: Vec<Array>) -> Array {
    // A struct has its validity alone.
    let buffers = values.as_ref().map_or_else(|| vec![ptr::null()], Values::buffers);
    let n_children = count(children.len());
    let children = boxed(children);
    let n_buffers = count(buffers.len());
    let mut owner = Box::new(ArrayOwner { _values: values, buffers, children });
    Array {
        length: count(rows),
        null_count: 0,
        offset: 0,
        n_buffers,
        n_children,
        buffers: owner.buffers.as_mut_ptr(),
        children: owner.children.as_mut_ptr(),
        dictionary: ptr::null_mut(),
        release: Some(release::<Array>),
        private_data: Box::into_raw(owner).cast(),
    }
}

/// The table of a stream.
///
/// # Safety
/// `stream` is a stream of this file that was not released.
unsafe fn table<'a>(stream: *mut Stream) -> &'a mut Table {
    // SAFETY: `private_data` was made by `Box::into_raw` in `arrow_stream`.
    unsafe { &mut *(*stream).private_data.cast::<Table>() }
}

/// # Safety
/// As the specification says of `get_schema`.
unsafe extern "C" fn get_schema(stream: *mut Stream, out: *mut Schema) -> c_int {
    // SAFETY: the consumer hands over a stream of ours and room for a schema.
    unsafe {
        let table = table(stream);
        let columns = table.names.iter().zip(&table.columns);
        let children =
            columns.map(|(name, values)| schema(values.format(), name.clone(), vec![])).collect();
        out.write(schema("+s", CString::default(), children));
    }
    0
}

/// # Safety
/// As the specification says of `get_next`.
unsafe extern "C" fn get_next(stream: *mut Stream, out: *mut Array) -> c_int {
    // SAFETY: the consumer hands over a stream of ours and room for an array.
    unsafe {
        let table = table(stream);
        if table.given {
            // A released array is the end: no pointer, no callback, nothing in it.
            out.write(std::mem::zeroed());
            return 0;
        }
        table.given = true;
        let columns = std::mem::take(&mut table.columns);
        let rows = table.rows;
        // The schema may be asked for again.
        table.columns = columns.iter().map(Values::emptied).collect();
        let children = columns.into_iter().map(|values| array(rows, Some(values), vec![]));
        out.write(array(rows, None, children.collect()));
    }
    0
}

/// There is no error to tell.
unsafe extern "C" fn get_last_error(_: *mut Stream) -> *const c_char {
    ptr::null()
}

/// Frees the table of a stream.
///
/// # Safety
/// `stream` is null or a stream of this file.
unsafe extern "C" fn release_stream(stream: *mut Stream) {
    // SAFETY: the table was made by `Box::into_raw` in `arrow_stream`.
    unsafe {
        let Some(stream) = stream.as_mut() else { return };
        if stream.private_data.is_null() {
            return;
        }
        drop(Box::from_raw(stream.private_data.cast::<Table>()));
        stream.private_data = ptr::null_mut();
        stream.release = None;
    }
}

/// Held by the capsule; a consumer moves the struct out by its bytes and sets `release` to null.
#[repr(transparent)]
struct Held(Stream);

// SAFETY: nothing in it belongs to a thread.
unsafe impl Send for Held {}

impl Drop for Held {
    fn drop(&mut self) {
        if let Some(release) = self.0.release {
            // SAFETY: it was not released, and the struct is still here.
            unsafe { release(&raw mut self.0) };
        }
    }
}

fn values(column: &Bound<'_, PyAny>) -> PyResult<Values> {
    if let Ok(doubles) = column.extract::<PyReadonlyArray1<'_, f64>>() {
        return Ok(Values::Doubles(doubles.as_slice()?.to_vec()));
    }
    if let Ok(integers) = column.extract::<PyReadonlyArray1<'_, i64>>() {
        return Ok(Values::Integers(integers.as_slice()?.to_vec()));
    }
    let texts: Vec<String> = column.extract()?;
    let (mut ends, mut bytes) = (vec![0], vec![]);
    for text in texts {
        bytes.extend_from_slice(text.as_bytes());
        ends.push(count(bytes.len()));
    }
    Ok(Values::Texts(ends, bytes))
}

/// A capsule named `arrow_array_stream` over a table of columns: one-dimensional arrays of doubles
/// or 64-bit integers, or lists of texts, all equally long.
#[pyfunction]
pub fn arrow_stream<'py>(
    py: Python<'py>,
    names: Vec<String>,
    columns: Vec<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let columns = columns.iter().map(values).collect::<PyResult<Vec<_>>>()?;
    let rows = columns.first().map_or(0, Values::len);
    if names.len() != columns.len() || columns.iter().any(|column| column.len() != rows) {
        return Err(internal("columns of a table are not equally long"));
    }
    let names = names.into_iter().map(|name| CString::new(name).unwrap_or_default()).collect();
    let table = Box::new(Table { names, columns, rows, given: false });
    let stream = Stream {
        get_schema: Some(get_schema),
        get_next: Some(get_next),
        get_last_error: Some(get_last_error),
        release: Some(release_stream),
        private_data: Box::into_raw(table).cast(),
    };
    PyCapsule::new_with_value(py, Held(stream), c"arrow_array_stream")
}
