//! What an array is made of: shared cells, and a view (offset, shape, strides) on them.

use crate::dtype::Dtype;
use crate::errors;
use rustpython_vm::{PyResult, VirtualMachine};
use std::{borrow::Cow, cell::Cell, rc::Rc};

/// The largest number of elements an array may have: enough for the labs, far from filling the memory of a submission.
pub const MAX_ELEMENTS: usize = 1_000_000;

/// The shape of an array of rank 0 (a number, inside this crate only), 1 or 2.
///
/// A vector counts as one row: this is numpy's rule for broadcasting, so operations need no case per rank.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Shape {
    rows: usize,
    columns: usize,
    rank: usize,
}

impl Shape {
    /// The shape of a number.
    pub const NUMBER: Self = Self {
        rows: 1,
        columns: 1,
        rank: 0,
    };

    /// The shape `(length,)`.
    #[must_use]
    pub const fn vector(length: usize) -> Self {
        Self {
            rows: 1,
            columns: length,
            rank: 1,
        }
    }

    /// The shape `(rows, columns)`.
    #[must_use]
    pub const fn matrix(rows: usize, columns: usize) -> Self {
        Self {
            rows,
            columns,
            rank: 2,
        }
    }

    /// The shape with these dimensions.
    ///
    /// # Errors
    ///
    /// ValueError for more than two dimensions.
    pub fn from_dimensions(dimensions: &[usize], vm: &VirtualMachine) -> PyResult<Self> {
        match *dimensions {
            [] => Ok(Self::NUMBER),
            [length] => Ok(Self::vector(length)),
            [rows, columns] => Ok(Self::matrix(rows, columns)),
            _ => Err(errors::too_many_dimensions(vm)),
        }
    }

    /// Rows, 1 for a vector.
    #[must_use]
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Columns; the length of a vector.
    #[must_use]
    pub const fn columns(&self) -> usize {
        self.columns
    }

    /// The number of dimensions.
    #[must_use]
    pub const fn rank(&self) -> usize {
        self.rank
    }

    /// The dimensions as numpy's `shape` has them.
    #[must_use]
    pub fn dimensions(&self) -> Vec<usize> {
        [self.rows, self.columns][2 - self.rank..].to_vec()
    }

    /// The number of elements.
    #[must_use]
    pub const fn size(&self) -> usize {
        self.rows.saturating_mul(self.columns)
    }

    /// The same elements with this rank, as far as the rows allow.
    #[must_use]
    pub const fn with_rank(self, rank: usize) -> Self {
        Self { rank, ..self }
    }

    /// Refuses a shape with too many elements; called before memory is taken.
    ///
    /// # Errors
    ///
    /// MemoryError above [`MAX_ELEMENTS`].
    pub fn check_size(&self, vm: &VirtualMachine) -> PyResult<()> {
        check_count(self.size(), vm)
    }

    /// As numpy writes it in its sentences: `(2,3)`, `(3,)`, `()`.
    #[must_use]
    pub fn sentence(&self) -> String {
        match self.rank {
            0 => "()".to_owned(),
            1 => format!("({},)", self.columns),
            _ => format!("({},{})", self.rows, self.columns),
        }
    }
}

/// Refuses this many elements when they are too many.
///
/// # Errors
///
/// MemoryError above [`MAX_ELEMENTS`].
pub fn check_count(count: usize, vm: &VirtualMachine) -> PyResult<()> {
    if count > MAX_ELEMENTS {
        return Err(vm.new_memory_error(format!(
            "an array of {count} elements: arrays here have at most {MAX_ELEMENTS}"
        )));
    }
    Ok(())
}

/// Elements in a shape: a window on cells that other views may share.
#[derive(Clone, Debug)]
pub struct View {
    cells: Rc<[Cell<f64>]>,
    offset: usize,
    shape: Shape,
    row_stride: isize,
    column_stride: isize,
    dtype: Dtype,
}

impl View {
    /// New cells with these values, row by row.
    ///
    /// # Panics
    ///
    /// When the number of values is not that of the shape: an error of this crate.
    #[must_use]
    pub fn new(dtype: Dtype, shape: Shape, values: Vec<f64>) -> Self {
        assert_eq!(values.len(), shape.size(), "values do not fill the shape");
        Self::of_cells(dtype, shape, values.into_iter().map(Cell::new).collect())
    }

    /// New cells of which there are as many as the shape has.
    fn of_cells(dtype: Dtype, shape: Shape, cells: Rc<[Cell<f64>]>) -> Self {
        Self {
            cells,
            offset: 0,
            shape,
            row_stride: shape.columns as isize,
            column_stride: 1,
            dtype,
        }
    }

    /// A new vector of floats.
    #[must_use]
    pub fn vector(values: Vec<f64>) -> Self {
        Self::new(Dtype::Float, Shape::vector(values.len()), values)
    }

    /// A new matrix of floats, row by row.
    #[must_use]
    pub fn matrix(rows: usize, columns: usize, values: Vec<f64>) -> Self {
        Self::new(Dtype::Float, Shape::matrix(rows, columns), values)
    }

    /// A number.
    #[must_use]
    pub fn number(dtype: Dtype, value: f64) -> Self {
        Self::new(dtype, Shape::NUMBER, vec![value])
    }

    /// The kind of the elements.
    #[must_use]
    pub const fn dtype(&self) -> Dtype {
        self.dtype
    }

    /// The shape.
    #[must_use]
    pub const fn shape(&self) -> Shape {
        self.shape
    }

    /// The number of elements.
    #[must_use]
    pub const fn size(&self) -> usize {
        self.shape.size()
    }

    /// The number of dimensions.
    #[must_use]
    pub const fn rank(&self) -> usize {
        self.shape.rank
    }

    /// Rows, 1 for a vector.
    #[must_use]
    pub const fn rows(&self) -> usize {
        self.shape.rows
    }

    /// Columns; the length of a vector.
    #[must_use]
    pub const fn columns(&self) -> usize {
        self.shape.columns
    }

    /// Where the element of this row and column is among the cells.
    #[must_use]
    pub const fn position(&self, row: usize, column: usize) -> usize {
        (self.offset as isize
            + row as isize * self.row_stride
            + column as isize * self.column_stride) as usize
    }

    /// The element of this row and column.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.cells[self.position(row, column)].get()
    }

    /// The cell at a position that [`View::position`] gave.
    #[must_use]
    pub fn cell(&self, position: usize) -> &Cell<f64> {
        &self.cells[position]
    }

    /// The element at this place, counted row by row.
    #[must_use]
    pub fn nth(&self, place: usize) -> f64 {
        let columns = self.shape.columns.max(1);
        self.at(place / columns, place % columns)
    }

    /// The positions of all elements, row by row.
    pub fn positions(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.shape.rows).flat_map(move |row| {
            (0..self.shape.columns).map(move |column| self.position(row, column))
        })
    }

    /// The cells of all elements, row by row, where they lie beside each other in this order.
    fn in_order(&self) -> Option<&[Cell<f64>]> {
        let lie_in_order = self.column_stride == 1
            && (self.shape.rows == 1 || self.row_stride == self.shape.columns as isize);
        lie_in_order.then(|| &self.cells[self.offset..self.offset + self.size()])
    }

    /// The elements row by row, copied only where they do not lie in this order.
    #[must_use]
    pub fn row_by_row(&self) -> Cow<'_, [Cell<f64>]> {
        match self.in_order() {
            Some(cells) => Cow::Borrowed(cells),
            None => Cow::Owned(self.values().into_iter().map(Cell::new).collect()),
        }
    }

    /// A new array of what `each` makes of every element.
    #[must_use]
    pub fn mapped(&self, dtype: Dtype, each: impl Fn(f64) -> f64) -> Self {
        let new = |cell: &Cell<f64>| Cell::new(each(cell.get()));
        let cells = match self.in_order() {
            Some(cells) => cells.iter().map(new).collect(),
            None => self
                .positions()
                .map(|position| new(&self.cells[position]))
                .collect(),
        };
        Self::of_cells(dtype, self.shape, cells)
    }

    /// A new array of what `each` makes of the pairs of elements of two arrays of one shape, as most are; `None` for others, and where elements do
    /// not lie in order.
    #[must_use]
    pub fn paired(
        &self,
        other: &Self,
        dtype: Dtype,
        each: impl Fn(f64, f64) -> f64,
    ) -> Option<Self> {
        if self.shape != other.shape {
            return None;
        }
        let pairs = self.in_order()?.iter().zip(other.in_order()?);
        let cells = pairs.map(|(left, right)| Cell::new(each(left.get(), right.get())));
        Some(Self::of_cells(dtype, self.shape, cells.collect()))
    }

    /// A copy of the elements, row by row.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.size());
        for row in 0..self.shape.rows {
            let mut position = self.position(row, 0) as isize;
            for _ in 0..self.shape.columns {
                values.push(self.cells[position as usize].get());
                position += self.column_stride;
            }
        }
        values
    }

    /// A copy with cells of its own, converted to `dtype`.
    #[must_use]
    pub fn cast(&self, dtype: Dtype) -> Self {
        let mut values = self.values();
        if dtype < self.dtype {
            for value in &mut values {
                *value = dtype.cast(*value);
            }
        }
        Self::new(dtype, self.shape, values)
    }

    /// A copy with cells of its own.
    #[must_use]
    pub fn copied(&self) -> Self {
        self.cast(self.dtype)
    }

    /// Whether both windows are on the same cells.
    #[must_use]
    pub fn shares_cells(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.cells, &other.cells)
    }

    /// The transpose, sharing cells; a vector stays as it is.
    #[must_use]
    pub fn transposed(&self) -> Self {
        if self.rank() < 2 {
            return self.clone();
        }
        Self {
            shape: Shape::matrix(self.shape.columns, self.shape.rows),
            row_stride: self.column_stride,
            column_stride: self.row_stride,
            ..self.clone()
        }
    }

    /// One row of a matrix as a vector that shares cells.
    #[must_use]
    pub fn row(&self, row: usize) -> Self {
        Self {
            offset: self.position(row, 0),
            shape: Shape::vector(self.shape.columns),
            ..self.clone()
        }
    }

    /// How far apart in the cells neighbouring rows and neighbouring columns are.
    #[must_use]
    pub const fn strides(&self) -> (isize, isize) {
        (self.row_stride, self.column_stride)
    }

    /// A window on the same cells: its first position, and for each dimension (at most two) the length and the stride.
    #[must_use]
    pub fn window(&self, first: usize, dimensions: &[(usize, isize)]) -> Self {
        let (shape, row_stride, column_stride) = match *dimensions {
            [(rows, row_stride), (columns, column_stride), ..] => {
                (Shape::matrix(rows, columns), row_stride, column_stride)
            }
            [(length, stride)] => (Shape::vector(length), 0, stride),
            [] => (Shape::NUMBER, 0, 0),
        };
        Self {
            offset: first,
            shape,
            row_stride,
            column_stride,
            ..self.clone()
        }
    }

    /// The column of a matrix as a vector that shares cells.
    #[must_use]
    pub fn column(&self, column: usize) -> Self {
        Self {
            offset: self.position(0, column),
            shape: Shape::vector(self.shape.rows),
            row_stride: 0,
            column_stride: self.row_stride,
            ..self.clone()
        }
    }

    /// The vector as a matrix of one column that shares cells.
    #[must_use]
    pub fn as_column(&self) -> Self {
        Self {
            shape: Shape::matrix(self.shape.columns, 1),
            row_stride: self.column_stride,
            column_stride: 1,
            ..self.clone()
        }
    }

    /// The vector or number as a matrix of one row that shares cells.
    #[must_use]
    pub fn as_row(&self) -> Self {
        Self {
            shape: self.shape.with_rank(2),
            ..self.clone()
        }
    }

    /// The elements in another shape of the same size: the same cells where they lie in order, else a copy.
    #[must_use]
    pub fn reshaped(&self, shape: Shape) -> Self {
        if shape.columns == self.shape.columns && shape.rows == self.shape.rows {
            return Self {
                shape,
                ..self.clone()
            };
        }
        let in_order = self.shape.rows <= 1
            || self.shape.columns == 0
            || self.row_stride == self.column_stride * self.shape.columns as isize
            || self.shape.columns == 1;
        if !in_order {
            return Self::new(self.dtype, shape, self.values());
        }
        let step = if self.shape.columns == 1 && self.shape.rows > 1 {
            self.row_stride
        } else {
            self.column_stride
        };
        Self {
            shape,
            column_stride: step,
            row_stride: step * shape.columns as isize,
            ..self.clone()
        }
    }

    /// The elements repeated to a larger shape without copying; `None` when the shape does not allow it.
    #[must_use]
    pub fn broadcast_to(&self, shape: Shape) -> Option<Self> {
        let fits = |from: usize, to: usize| from == to || from == 1;
        if !fits(self.shape.rows, shape.rows) || !fits(self.shape.columns, shape.columns) {
            return None;
        }
        let stride = |from: usize, to: usize, stride: isize| if from == to { stride } else { 0 };
        Some(Self {
            row_stride: stride(self.shape.rows, shape.rows, self.row_stride),
            column_stride: stride(self.shape.columns, shape.columns, self.column_stride),
            shape,
            ..self.clone()
        })
    }

    /// Writes the values of `source`, which has been broadcast to this shape, into the cells of this view.
    pub fn assign(&self, source: &Self) {
        // values are read before any is written, because both may look at the same cells
        let values = source.values();
        for (position, value) in self.positions().zip(values) {
            self.cells[position].set(self.dtype.cast(value));
        }
    }
}
