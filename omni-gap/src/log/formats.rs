//! # The forms of files, explained to the person who writes them

/// A page about one form.
#[derive(Debug, Clone, Copy)]
pub struct FormatPage {
    /// What to ask for.
    pub name: &'static str,
    /// What it is about, in a line.
    pub title: &'static str,
    /// The page, in Markdown.
    pub text: &'static str,
}

/// All pages.
pub const FORMATS: [FormatPage; 3] = [
    FormatPage { name: "robot", title: "robot.toml, and how wheels are numbered", text: include_str!("robot.md") },
    FormatPage { name: "runs", title: "sessions, and the columns of a run", text: include_str!("runs.md") },
    FormatPage {
        name: "columns",
        title: "columns.toml: logs in another layout, Parquet, MCAP, ROS bags and game logs of SSL-Vision",
        text: include_str!("columns.md"),
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::target::Target;

    #[test]
    fn every_column_of_the_page_is_one_and_none_is_left_out() {
        let rows = FORMATS[1].text.lines().filter(|line| line.starts_with("| `"));
        let names: Vec<&str> =
            rows.flat_map(|row| row.split('|').nth(1).unwrap().split('`').skip(1).step_by(2)).collect();
        assert!(names.iter().all(|name| Target::named(name).is_some()), "{names:?}");
        let all = [
            "t_s",
            "u0_V",
            "wset0_rad_s",
            "i0_A",
            "w0_rad_s",
            "x_m",
            "y_m",
            "theta_rad",
            "gyro_rad_s",
            "vbat_V",
            "enable",
        ];
        assert_eq!(names, all);
    }
}
