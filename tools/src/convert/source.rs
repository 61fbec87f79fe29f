//! `<source>`: arrays of numbers and the accessors that say how to read them.
//!
//! Counts in the file are compared with what is really there and never trusted for a size.

use super::xml::{Reader, Xml, child, children, path, start};

/// Tuples of numbers read through an accessor.
#[derive(Clone, Debug)]
pub(crate) struct Tuples {
    width: usize,
    values: Vec<f64>,
}

impl Tuples {
    /// Number of tuples.
    pub fn len(&self) -> usize {
        self.values.len() / self.width
    }

    /// The first `N` numbers of a tuple; 0 where it is shorter.
    pub fn get<const N: usize>(&self, i: usize) -> [f64; N] {
        let tuple = &self.values[i * self.width..(i + 1) * self.width];
        std::array::from_fn(|k| tuple.get(k).copied().unwrap_or(0.0))
    }
}

/// Tuples may skip numbers between them; by more than this and the file is nonsense.
const MAX_STRIDE: usize = 1024;

impl<'a> Reader<'a> {
    /// Read a `<source>` as tuples of at least `width` numbers each.
    pub fn tuples(&mut self, source: Xml<'a>, width: usize) -> Option<Tuples> {
        let Some(array) = child(source, "float_array") else {
            let message = "a <source> without a <float_array>";
            let hint = "positions, normals and texture coordinates must be float arrays";
            self.diag.error(start(source), message, hint);
            return None;
        };
        let data = self.floats(array)?;
        let declared = self.count(array, "count", data.len())?;
        if declared != data.len() {
            let n = data.len();
            let message = format!("<float_array> says count=\"{declared}\" and holds {n} numbers");
            let remedy = "the numbers that are there are used";
            self.diag.fault(start(array), message, remedy);
        }
        let Some(accessor) = path(source, &["technique_common", "accessor"]) else {
            let message = "a <source> without an <accessor>";
            let remedy = "the numbers are read without gaps";
            self.diag.fault(start(source), message, remedy);
            let whole = data.len() - data.len() % width;
            let values = data[..whole].to_vec();
            return Some(Tuples { width, values });
        };
        self.read_accessor(accessor, &data, width)
    }

    fn read_accessor(&mut self, accessor: Xml<'a>, data: &[f64], width: usize) -> Option<Tuples> {
        let stride = self.count(accessor, "stride", 1)?;
        let offset = self.count(accessor, "offset", 0)?;
        // Nameless parameters are numbers to be skipped.
        let mut columns: Vec<usize> = children(accessor, "param")
            .enumerate()
            .filter(|(_, p)| p.attribute("name").is_some_and(|n| !n.is_empty()))
            .map(|(i, _)| i)
            .take(width)
            .collect();
        if columns.is_empty() {
            // Some writers leave all names out and mean all numbers.
            columns = (0..stride.min(width)).collect();
        }
        let reach = columns.last().map_or(0, |c| c + 1);
        if stride == 0 || stride > MAX_STRIDE || reach > stride || columns.len() < width {
            let message = format!(
                "an <accessor> of stride {stride} with {} named parameters; {width} numbers are needed",
                columns.len()
            );
            let hint = "the stride must cover the parameters";
            self.diag.error(start(accessor), message, hint);
            return None;
        }
        let available = data.get(offset..).map_or(0, |d| {
            // The last tuple need not be filled up to the stride.
            (d.len() + stride - reach) / stride
        });
        let declared = self.count(accessor, "count", available)?;
        if declared > available {
            let message = format!("an <accessor> of {declared} tuples where {available} fit");
            let remedy = "the tuples that fit are used";
            self.diag.fault(start(accessor), message, remedy);
        }
        let n = declared.min(available);
        let mut values = Vec::with_capacity(n * width);
        for i in 0..n {
            let base = offset + i * stride;
            values.extend(columns.iter().map(|c| data[base + c]));
        }
        Some(Tuples { width, values })
    }
}
