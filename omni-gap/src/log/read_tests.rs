use super::*;

fn read(text: &[u8], wheels: usize) -> Result<(Run, Vec<String>)> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    std::fs::write(&path, text).unwrap();
    Run::load(&path, wheels, None)
}

const HEADER: &str = "t_s,u0_V,u1_V,u2_V,x_m,y_m,theta_rad,note\n";

#[test]
fn a_log_of_the_contract_is_read_with_its_holes() {
    let text = format!("{HEADER}0,1,2,3,0.5,0,0,7\r\n0.01, 1 ,,3e0,,,,7\n");
    let (run, notices) = read(text.as_bytes(), 3).unwrap();
    assert_eq!((run.name.as_str(), run.t_s.as_slice()), ("a", [0.0, 0.01].as_slice()));
    let u = run.u.unwrap();
    assert_eq!(
        (u.channels[0].get(1), u.channels[1].get(1), u.channels[2].get(1)),
        (Ok(1.0), Err(Missing::Blank), Ok(3.0))
    );
    assert_eq!(run.pose.unwrap().channels[2].get(1), Err(Missing::Blank));
    assert!(notices.len() == 1 && notices[0].ends_with("columns left out: `note`"), "{notices:?}");
}

#[test]
fn of_many_columns_that_are_left_out_some_are_told_by_name() {
    let more = |of: &dyn Fn(usize) -> String| (0..100_000).map(|k| ",".to_owned() + &of(k)).collect::<String>();
    let row = more(&|_| "1".to_owned());
    let text = format!("t_s,x_m,y_m,theta_rad{}\n0,1,2,3{row}\n1,1,2,3{row}\n", more(&|k| format!("c{k}")));
    let (_, notices) = read(text.as_bytes(), 3).unwrap();
    assert!(notices[0].ends_with("`c18`, `c19` and 99980 more"), "{}", notices[0]);
}

#[test]
fn what_is_written_is_read_again() {
    let text = format!("{HEADER}0,1.25,2,3,0.5,0,0,7\n0.01,1,,3e-7,,,,7\n");
    let (run, _) = read(text.as_bytes(), 3).unwrap();
    let mut bytes = Vec::new();
    run.write_csv(&mut bytes).unwrap();
    let (again, _) = read(&bytes, 3).unwrap();
    assert_eq!((again.u, again.pose, again.t_s), (run.u, run.pose, run.t_s));
}

#[test]
fn a_group_that_is_empty_throughout_counts_as_absent() {
    let text = format!("{HEADER}0,1,2,3,,,,7\n0.01,1,2,3,,,,7\n");
    let (run, notices) = read(text.as_bytes(), 3).unwrap();
    assert!(run.pose.is_none() && notices[1].contains("group `pose` is empty; it counts as absent"), "{notices:?}");
}

#[test]
fn each_mistake_in_a_log_has_its_line_and_column() {
    let rows = |rows: &str| format!("{HEADER}{rows}").into_bytes();
    let mistakes: [(Vec<u8>, &str); 18] = [
        (b"".to_vec(), "a.csv: the file is empty"),
        (b" \n\n".to_vec(), "the file is empty"),
        (rows(""), "there is a header and no rows"),
        (rows("0,1,2,3,0,0,0,0\n"), "there is a header and one row"),
        (rows("0,1,2,3,0,0,0,0\n0.01,1,2,x,0,0,0,0\n"), "a.csv:3: column `u2_V`: found `x`, expected a finite number"),
        (rows("0,1,2,3,0,0,0,0\n\n0.01,1,2,NaN,0,0,0,0\n"), "a.csv:4: column `u2_V`: found `NaN`"),
        (rows("0,1,2,3,0,0,0,0\n0.01,1,2,inf,0,0,0,0\n"), "found `inf`"),
        (rows("0,1,2,3,0,0,0,0\n0.01,1,2,1e999,0,0,0,0\n"), "found `1e999`"),
        (rows("0,1,2,3,0,0,0,0\n0.01,1,2\n"), "a.csv:3: found 3 fields, expected 8"),
        (rows("0,1,2,3,0,0,0,0\n0.01,1,2,3,4,5,6,7,8\n"), "a.csv:3: found 9 fields, expected 8"),
        (rows("0,1,2,3,0,0,0,0\n0,1,2,3,0,0,0,0\n"), "a.csv:3: column `t_s`: found 0 s after 0 s, a repeated time"),
        (rows("1,1,2,3,0,0,0,0\n0.5,1,2,3,0,0,0,0\n"), "found 0.5 s after 1 s, a time that runs back"),
        (rows(",1,2,3,0,0,0,0\n0.5,1,2,3,0,0,0,0\n"), "a.csv:2: column `t_s`: the time is missing"),
        (b"t_s,u0_V,u1_V\n0,1,2\n".to_vec(), "column `u2_V`: the column is missing: 2 of 3 wheels have one"),
        (
            b"t_s,u0_V,u1_V,u2_V,u3_V\n0,1,2,3,4\n".to_vec(),
            "column `u3_V`: a column for a wheel that the robot file does not have",
        ),
        (b"u0_V,u1_V,u2_V\n1,2,3\n".to_vec(), "column `t_s`: the column is missing"),
        (b"t_s,a,b\n0,1,2\n".to_vec(), "found no signal, expected at least one of"),
        (b"0,1,2\n0,1,2\n".to_vec(), "a.csv:1: found a line of numbers, expected a header line"),
    ];
    for (text, expected) in mistakes {
        let told = read(&text, 3).expect_err(expected).to_string();
        assert!(told.contains(expected), "expected: {expected}\n    told: {told}");
    }
}

#[test]
fn more_mistakes_are_told() {
    let told = |text: &[u8]| read(text, 3).unwrap_err().to_string();
    assert!(told(b"t_s,x_m,\xff,theta_rad\n0,1,1,1\n").contains("a.csv:1: found bytes that are not UTF-8"));
    assert!(told(b"t_s,x_m,y_m,theta_rad\n0,1,1,1\n1,1,\xff,1\n").contains("a.csv:3: found bytes that are not UTF-8"));
    assert!(told(b"t_s,x_m,y_m\n0,1,1\n").contains("column `theta_rad`: the column is missing"));
    assert!(told(b"t_s,x_m,x_m\n0,1,1\n").contains("a.csv:1: column `x_m`: the column stands twice"));
    assert!(told(b"t_s,x_m,y_m,theta_rad\n0,,,\n1,,,\n").contains("every signal is empty throughout"));
    let folder = tempfile::tempdir().unwrap();
    let told = Run::load(folder.path(), 3, None).unwrap_err().to_string();
    assert!(told.contains("this is a folder, expected a run log"));
}
