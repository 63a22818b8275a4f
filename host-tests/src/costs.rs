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

/// The most instructions that an effect which is undone may add to a motion turn.
pub const MOST_ADDED: u32 = 600;

/// The part that effects add to, and what a part begins with in which one is undone.
const PLAIN: &str = "motion tick, 4 wheels";
const UNDOING: &str = "motion tick, 4 wheels, undoing ";

/// What is promised of these costs and does not hold.
pub fn broken_promises(costs: &[Cost]) -> Vec<String> {
    let Some(plain) = costs.iter().find(|cost| cost.part == PLAIN) else {
        return vec![format!("{PLAIN} is not there")];
    };
    let added = |cost: &Cost| {
        let effect = cost.part.strip_prefix(UNDOING)?;
        let added = cost.instructions.saturating_sub(plain.instructions);
        (added > MOST_ADDED).then(|| format!("undoing {effect} adds {added} instructions, {MOST_ADDED} at the most"))
    };
    costs.iter().filter_map(added).collect()
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
    fn an_effect_that_adds_too_much_is_told_and_on_the_page_there_is_none() {
        let undoing = |instructions| Cost { part: format!("{UNDOING}creep"), instructions };
        let with = |instructions| [costs(300), vec![undoing(instructions)]].concat();
        assert!(broken_promises(&with(900)).is_empty());
        assert_eq!(broken_promises(&with(901)), ["undoing creep adds 601 instructions, 600 at the most"]);
        assert_eq!(broken_promises(&[]).len(), 1);
        let page = std::fs::read_to_string(crate::golden::path("cycles.md")).expect("the page");
        let row = |line: &str| {
            let (part, count) = line.trim_matches('|').split_once('|')?;
            Some(Cost { part: part.trim().to_owned(), instructions: count.trim().parse().ok()? })
        };
        let recorded: Vec<Cost> = page.lines().filter_map(row).collect();
        assert!(recorded.iter().filter(|cost| cost.part.starts_with(UNDOING)).count() > 20);
        assert_eq!(broken_promises(&recorded), Vec::<String>::new());
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
