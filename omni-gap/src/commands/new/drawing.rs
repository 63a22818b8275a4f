//! A robot from above: its wheels where they touch the floor, and where they roll.

use omni_gap::log::WheelFile;

const ROWS: usize = 11;
const COLUMNS: usize = 25;

/// The drawing, forward being up. An arrow shows where a wheel rolls while its speed is positive.
pub fn drawing(wheels: &[WheelFile]) -> String {
    let mut canvas = vec![vec![' '; COLUMNS]; ROWS];
    let (middle_row, middle_column) = (ROWS / 2, COLUMNS / 2);
    canvas[middle_row][middle_column] = 'o';
    canvas[middle_row - 1][middle_column] = '│';
    canvas[middle_row - 2][middle_column] = '▲';
    for (number, wheel) in wheels.iter().enumerate() {
        let angle = wheel.drive_angle_deg.to_radians();
        // the wheel j touches the floor in the direction a − 90°
        let at = angle - std::f64::consts::FRAC_PI_2;
        let row = (middle_row as f64 - at.cos() * 4.0).round() as usize;
        let column = (middle_column as f64 - at.sin() * 8.0).round() as usize;
        canvas[row][column] = char::from_digit(number as u32, 10).unwrap_or('?');
        canvas[row][column + 1] = arrow(angle);
    }
    let row = |(row, letters): (usize, &Vec<char>)| {
        let words = match row {
            0 => "   seen from above, forward is up",
            1 => "   arrows: where a wheel rolls while its speed is positive,",
            2 => "   which is to the left round the robot for all of them",
            _ => "",
        };
        format!("{}{words}", letters.iter().collect::<String>()).trim_end().to_owned() + "\n"
    };
    canvas.iter().enumerate().map(row).collect()
}

/// The arrow that is nearest to a direction, from forward (up) to the left.
fn arrow(angle: f64) -> char {
    const ARROWS: [char; 8] = ['↑', '↖', '←', '↙', '↓', '↘', '→', '↗'];
    let eighth = (angle / std::f64::consts::FRAC_PI_4).round() as i64;
    ARROWS[eighth.rem_euclid(8) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wheels_stand_where_they_touch_and_arrows_point_where_they_roll() {
        let wheel = |drive_angle_deg| WheelFile { drive_angle_deg, distance_m: 0.1, radius_m: 0.03 };
        let text = drawing(&[90.0, 180.0, 270.0, 0.0].map(wheel));
        let lines: Vec<Vec<char>> = text.lines().map(|line| line.chars().collect()).collect();
        let at = |row: usize, column: usize| -> String { lines[row][column..column + 2].iter().collect() };
        assert_eq!((at(1, 12), at(5, 4), at(9, 12), at(5, 20)), ("0←".into(), "1↓".into(), "2→".into(), "3↑".into()));
    }
}
