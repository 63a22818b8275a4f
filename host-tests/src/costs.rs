//! # Costs: instructions of the control path, as the emulator counts them
//!
//! The image `cycles` prints a line for each part: its instructions, a tab, its name. A golden page is the record of them;
//! what departs from it is told, and is no failure.

/// What one part of the control path costs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cost {
    /// What is called
    pub part: String,
    /// Instructions of one call
    pub instructions: u32,
}

/// Share that a cost may depart from the page, which was made by one version of the compiler [1].
const ROOM: f64 = 0.05;

impl Cost {
    /// The lines of the image.
    pub fn read(said: &str) -> Vec<Cost> {
        let line = |line: &str| {
            let (count, part) = line.split_once('\t')?;
            Some(Cost { part: part.trim().to_owned(), instructions: count.trim().parse().ok()? })
        };
        said.lines().filter_map(line).collect()
    }
}

/// The page of all costs.
pub fn page(costs: &[Cost]) -> String {
    let mut text = "# What the control path costs\n\n\
        Instructions of one call on a Cortex-M4F, counted in QEMU with `-icount` by `cargo xtask emulate`; the callee is not\n\
        inlined, its inputs are not constant, the loop around it is taken off. Instructions are not cycles: loads, branches and\n\
        flash wait states cost more on a chip.\n\n\
        | part | instructions |\n|---|---|\n"
        .to_owned();
    for cost in costs {
        text += &format!("| {} | {} |\n", cost.part, cost.instructions);
    }
    text
}

/// What departs from a golden page by more than another compiler may.
pub fn differences(golden: &str, costs: &[Cost]) -> Vec<String> {
    let row = |part: &str| {
        golden.lines().find_map(|line| {
            let mut cells = line.trim_matches('|').split('|').map(str::trim);
            (cells.next()? == part).then(|| cells.next()?.parse::<f64>().ok()).flatten()
        })
    };
    let departs = |cost: &Cost| match row(&cost.part) {
        None => Some(format!("{} is not there", cost.part)),
        Some(was) => {
            let now = f64::from(cost.instructions);
            ((now - was).abs() > ROOM * was).then(|| format!("{}: {was} there, {now} now", cost.part))
        }
    };
    costs.iter().filter_map(departs).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn costs(tick: u32) -> Vec<Cost> {
        [("motion tick, 4 wheels", tick), ("six-step current tick", 66)]
            .map(|(part, instructions)| Cost { part: part.to_owned(), instructions })
            .to_vec()
    }

    #[test]
    fn the_page_says_what_the_image_said() {
        let read = Cost::read("246\tmotion tick, 4 wheels\nnoise\n66\tsix-step current tick\r\n");
        assert_eq!(read.len(), 2);
        assert!(page(&read).contains("| motion tick, 4 wheels | 246 |"));
        assert!(differences(&page(&read), &read).is_empty());
    }

    #[test]
    fn a_part_that_grew_is_told_and_a_compilers_whim_is_not() {
        let golden = page(&costs(200));
        assert!(differences(&golden, &costs(209)).is_empty());
        assert_eq!(differences(&golden, &costs(220)), ["motion tick, 4 wheels: 200 there, 220 now"]);
        assert_eq!(differences("", &costs(200)).len(), 2);
    }
}
