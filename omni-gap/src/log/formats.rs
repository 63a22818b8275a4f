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
        title: "columns.toml: logs in another layout, Parquet, MCAP and ROS bags",
        text: include_str!("columns.md"),
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::RobotFile;
    use crate::log::target::Target;
    use std::path::Path;

    #[test]
    fn the_robot_of_the_page_can_be_read_and_has_every_key() {
        let page = FORMATS[0].text;
        let toml = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
        let robot = RobotFile::parse(toml, Path::new("robot.toml"), &crate::known::known_effects()).unwrap();
        assert_eq!((robot.wheel.len(), robot.effects.len()), (3, 2));
        // every member that a robot can have is there: none of the optional ones is null
        let written = serde_json::to_value(&robot).unwrap();
        let absent = |table: &str| written[table].as_object().is_none_or(|table| table.values().any(|v| v.is_null()));
        let silent: Vec<&str> =
            ["motor", "body", "friction", "sensors", "supply", "limits"].into_iter().filter(|t| absent(t)).collect();
        assert!(silent.is_empty(), "{silent:?}");
    }

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
