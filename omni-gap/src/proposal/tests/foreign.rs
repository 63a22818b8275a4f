//! How another program would have written a recording: columns of any names, in any units.

use crate::log::Run;

/// Columns of a foreign log: a name, and the number of each row.
pub(super) type Foreign = Vec<(String, Box<dyn Fn(&Run, usize) -> Option<f64>>)>;

/// How a foreign log is written.
pub(super) struct Layout {
    pub(super) wheels: usize,
    pub(super) separator: &'static str,
    pub(super) decimal: char,
    pub(super) above: &'static str,
    pub(super) header: bool,
    pub(super) columns: Foreign,
}

impl Layout {
    pub(super) fn new(wheels: usize) -> Layout {
        Layout { wheels, separator: ",", decimal: '.', above: "", header: true, columns: Vec::new() }
    }

    pub(super) fn column(mut self, name: &str, of: impl Fn(&Run, usize) -> Option<f64> + 'static) -> Layout {
        self.columns.push((name.to_owned(), Box::new(of)));
        self
    }

    /// A column for each wheel; `order` says of which wheel the first, the second and so on are.
    pub(super) fn of_wheels(
        mut self,
        name: impl Fn(usize) -> String,
        order: &[usize],
        of: fn(&Run, usize, usize) -> Option<f64>,
    ) -> Layout {
        for (place, wheel) in order.iter().copied().enumerate() {
            self = self.column(&name(place), move |run, row| of(run, wheel, row));
        }
        self
    }

    pub(super) fn text(&self, run: &Run) -> String {
        let mut text = self.above.to_owned();
        let join = |fields: Vec<String>| fields.join(self.separator) + "\n";
        if self.header {
            text += &join(self.columns.iter().map(|(name, _)| name.clone()).collect());
        }
        for row in 0..run.rows() {
            let field = |of: Option<f64>| {
                of.map_or(String::new(), |value| format!("{value}").replace('.', &self.decimal.to_string()))
            };
            text += &join(self.columns.iter().map(|(_, of)| field(of(run, row))).collect());
        }
        text
    }
}

pub(super) fn time(scale: f64, since: f64) -> impl Fn(&Run, usize) -> Option<f64> {
    move |run, row| Some((since + run.t_s[row]) * scale)
}

fn at(group: &Option<crate::log::Group>, channel: usize, row: usize) -> Option<f64> {
    group.as_ref()?.channels[channel].get(row).ok()
}

pub(super) fn w(run: &Run, wheel: usize, row: usize) -> Option<f64> {
    at(&run.w, wheel, row)
}

pub(super) fn u(run: &Run, wheel: usize, row: usize) -> Option<f64> {
    at(&run.u, wheel, row)
}

pub(super) fn i(run: &Run, wheel: usize, row: usize) -> Option<f64> {
    at(&run.i, wheel, row)
}

pub(super) fn pose(channel: usize, factor: f64, offset: f64) -> impl Fn(&Run, usize) -> Option<f64> {
    move |run, row| Some(factor * at(&run.pose, channel, row)? + offset)
}
