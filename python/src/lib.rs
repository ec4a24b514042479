//! The native part of `vibro_audit`: asks the library and hands over plain data; all else is in `python/vibro_audit`.

mod flight;
mod watched;

use pyo3::exceptions::PyRuntimeError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyDict, PyList};
use std::ffi::OsString;
use vibro_audit::cli::{self, Failure, Input, Reply};
use vibro_audit::report::{Cell, Frame, Values};

/// A column: its name, and numbers as (format of `struct`, shape, bytes), or a list.
type Column = (String, Py<PyAny>);

/// Rows and columns of each table, the page, the text, the exit status, the notes.
type Found = (
    Vec<(usize, Vec<Column>)>,
    Option<String>,
    Option<String>,
    u8,
    Vec<String>,
);

/// Answers a command line without the program's name; `input`, a name and a text, stands for stdin.
#[pyfunction]
fn ask(py: Python<'_>, arguments: Vec<OsString>, input: Option<(String, String)>) -> PyResult<Found> {
    let line = std::iter::once(OsString::from("vibro-audit")).chain(arguments);
    let line: Vec<OsString> = line.collect();
    let input = input.map(|(name, text)| Input { name, text });
    let reply = watched::run(py, move || cli::ask(line, input))?.map_err(|failure| refused(py, &failure))?;
    let Reply {
        tables,
        page,
        text,
        exit,
        notes,
    } = reply;
    let tables: PyResult<Vec<_>> = tables.into_iter().map(|table| columns(py, table)).collect();
    Ok((tables?, page, text, exit.code(), notes))
}

/// An `InputError` with its place.
fn refused(py: Python<'_>, failure: &Failure) -> PyErr {
    let (path, line, column) = failure.place();
    input_error(py, (failure.to_string(), path, line, column))
}

/// An `InputError` of these arguments.
fn input_error<'py>(py: Python<'py>, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let made = py
        .import(intern!(py, "vibro_audit._errors"))
        .and_then(|module| module.getattr(intern!(py, "InputError")))
        .and_then(|class| class.call1(arguments));
    made.map_or_else(|error| error, PyErr::from_value)
}

fn columns(py: Python<'_>, table: Frame) -> PyResult<(usize, Vec<Column>)> {
    let mut columns = Vec::with_capacity(table.columns.len());
    for (name, values) in table.columns {
        if let Values::Cells(cells) = &values
            && cells.iter().any(|cell| matches!(cell, Cell::Values(..)))
        {
            let named: PyResult<Vec<_>> = cells.iter().map(|cell| named(py, cell)).collect();
            let named = PyList::new(py, named?)?;
            columns.push((name.clone(), column(py, values)?));
            columns.push((format!("{name}_values"), named.into_any().unbind()));
        } else {
            columns.push((name, column(py, values)?));
        }
    }
    Ok((table.rows, columns))
}

/// The values of a cell that has such, by their names.
fn named<'py>(py: Python<'py>, cell: &Cell) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Cell::Values(_, values) = cell else {
        return Ok(None);
    };
    let named = PyDict::new(py);
    for (name, value) in values {
        named.set_item(name, value)?;
    }
    Ok(Some(named))
}

fn column(py: Python<'_>, values: Values) -> PyResult<Py<PyAny>> {
    Ok(match values {
        Values::Numbers(own) => buffer(py, "d", &[own.len()], &own, f64::to_ne_bytes)?,
        Values::Integers(own) => buffer(py, "q", &[own.len()], &own, i64::to_ne_bytes)?,
        Values::Flags(own) => buffer(py, "?", &[own.len()], &own, |flag| [u8::from(flag)])?,
        Values::Cells(cells) => {
            let cells: PyResult<Vec<_>> = cells.into_iter().map(|cell| object(py, cell)).collect();
            PyList::new(py, cells?)?.into_any().unbind()
        }
        Values::Decimals(own) => {
            let own = own
                .iter()
                .map(|text| text.as_deref().map(|text| decimal(py, text)).transpose());
            let own: PyResult<Vec<_>> = own.collect();
            PyList::new(py, own?)?.into_any().unbind()
        }
    })
}

/// Numbers one behind the other, in memory that Python owns.
fn buffer<T: Copy, const N: usize>(
    py: Python<'_>,
    format: &str,
    shape: &[usize],
    values: &[T],
    bytes: impl Fn(T) -> [u8; N],
) -> PyResult<Py<PyAny>> {
    let array = PyByteArray::new_with(py, N * values.len(), |to| {
        for (to, value) in to.chunks_exact_mut(N).zip(values) {
            to.copy_from_slice(&bytes(*value));
        }
        Ok(())
    })?;
    Ok((format, shape.to_vec(), array).into_pyobject(py)?.into_any().unbind())
}

fn decimal<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import(intern!(py, "decimal"))?
        .call_method1(intern!(py, "Decimal"), (text,))
}

fn object(py: Python<'_>, cell: Cell) -> PyResult<Bound<'_, PyAny>> {
    Ok(match cell {
        Cell::Text(text) | Cell::Values(text, _) => text.into_pyobject(py)?.into_any(),
        Cell::Number(number) => number.into_pyobject(py)?.into_any(),
        Cell::Numbers(numbers) => numbers.into_pyobject(py)?,
        Cell::Decimal(number) => decimal(py, number.as_str())?,
        Cell::Decimals(numbers) => {
            let numbers: PyResult<Vec<_>> = numbers.iter().map(|number| decimal(py, number.as_str())).collect();
            numbers?.into_pyobject(py)?
        }
        Cell::Integer(count) => count.into_pyobject(py)?.into_any(),
        Cell::Flag(flag) => flag.into_pyobject(py)?.to_owned().into_any(),
        Cell::Empty => py.None().into_bound(py),
    })
}

/// A fault of ours.
fn fault(what: &str) -> PyErr {
    PyRuntimeError::new_err(format!("{what}: this is a fault of vibro-audit, please report it"))
}

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(ask, module)?)?;
    module.add_function(wrap_pyfunction!(flight::next_impact, module)?)
}
