use super::super::robot_read::tests::{GOOD, read, refusal};

#[test]
fn a_number_in_another_unit_is_told_with_what_was_probably_meant() {
    for (from, to, line, expected) in [
        (
            "mass_kg = 1.944",
            "mass_kg = 1944",
            20,
            "column `mass_kg`: found 1944, expected a number from 0.02 to 1000 kg. Write 1.944, if the number is in g",
        ),
        ("mass_kg = 1.944", "mass_kg = 944", 20, "do not belong to one robot"),
        ("mass_kg = 1.944", "mass_kg = 1e200", 20, "found 1e200, expected"),
        (
            "radius_m = 0.0325",
            "radius_m = 30.0",
            5,
            "found 30, expected a number from 0.002 to 0.6 m. Write 0.03, if the number is in mm",
        ),
        ("distance_m = 0.089", "distance_m = 89", 4, "Write 0.089, if the number is in mm"),
        (
            "gear_ratio = 5.0",
            "gear_ratio = 0.2",
            15,
            "expected a number from 0.45 to 1000 motor turns in a turn of the wheel. Write 5, if the number is in wheel turns",
        ),
        ("resistance_ohm = 4.3111", "resistance_ohm = 4311.1", 16, "Write 4.3111, if the number is in mΩ"),
        // 60 / (2π · 368.7 rpm/V) = 0.0259 V/(rad/s)
        ("emf_constant_V_s = 0.0259", "emf_constant_V_s = 368.7", 17, "Write 0.0259, if the number is in rpm/V"),
        (
            "torque_constant_Nm_per_A = 0.0259",
            "torque_constant_Nm_per_A = 25.9",
            18,
            "Write 0.0259, if the number is in mN·m/A",
        ),
        // a small motor's 1.5 mN·m/A passes alone, and not beside its Kv
        ("torque_constant_Nm_per_A = 0.0259", "torque_constant_Nm_per_A = 1.5", 18, "57.915 times its EMF constant"),
        ("inertia_kg_m2 = 0.0169", "inertia_kg_m2 = 169", 20, "do not belong to one robot"),
    ] {
        let told = refusal(&GOOD.replacen(from, to, 1));
        let place = format!("robot.toml:{line}:");
        assert!(told.starts_with(&place) && told.contains(expected), "expected {place} {expected}\n    told: {told}");
    }
}

#[test]
fn friction_noise_and_uncertainty_have_bounds_too() {
    for (added, expected) in [
        // 5 times the weight of 1.944 kg are 95.32 N
        (
            "[friction]\ncoulomb_v_N = 1906.8\n",
            "robot.toml:23: column `coulomb_v_N`: found 1906.8, expected at most 95.321 N",
        ),
        ("[friction]\nviscous_v_N_s_per_m = 1e200\n", "expected a number from 0 to 10000 N·s/m"),
        ("[sensors]\nposition_noise_m = 3\n", "Write 0.003, if the number is in mm"),
        ("[sensors]\ncurrent_noise_A = 1e-300\n", "expected a number from 1e-9 to 100 A"),
        ("[uncertainty]\nmass_kg = 5\n", "Write 0.05, if the number is in per cent"),
        ("[supply]\nvoltage_V = 12000\n", "Write 12, if the number is in mV"),
    ] {
        let told = refusal(&format!("{GOOD}{added}"));
        assert!(told.contains(expected), "expected: {expected}\n    told: {told}");
    }
}

#[test]
fn drive_angles_in_radians_are_told() {
    let radians = GOOD.replace("150.0", "2.618").replace("270.0", "4.712").replace("= 30\n", "= 0.5236\n");
    assert!(refusal(&radians).contains("robot.toml:2: the drive angles look like radians"), "{}", refusal(&radians));
}

#[test]
fn robots_far_apart_in_size_are_taken() {
    let tiny = [("0.089", "0.02"), ("0.0325", "0.006"), ("1.944", "0.08"), ("0.0169", "0.00003"), ("0.0259", "0.0012")];
    let large = [("0.089", "0.6"), ("0.0325", "0.15"), ("1.944", "250"), ("0.0169", "40"), ("0.0259", "0.4")];
    for changes in [tiny, large] {
        let text = changes.iter().fold(GOOD.to_string(), |text, (from, to)| text.replace(from, to));
        assert!(read(&text).is_ok(), "{:?}", read(&text));
    }
}
