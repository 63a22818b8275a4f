//! The printed matrices, the derived ones and the exact flow, each against something else.

use host_tests::flow::{Flow, zeros};
use host_tests::matrices::{Matrices, eq33_as_printed};
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, THREE_HEADINGS_DEG, THREE_WHEELS};
use nalgebra::{DMatrix, Matrix3, Vector3};

/// Largest difference of two lists of numbers.
fn gap(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn assert_same<const N: usize>(printed: &Matrices<N>, derived: &Matrices<N>) {
    // Ten roundings of entries of size 10 and less.
    let tolerance = 1e-14;
    for (name, a, b) in [
        ("A", printed.a.as_slice(), derived.a.as_slice()),
        ("B", printed.b.as_slice(), derived.b.as_slice()),
        ("K", printed.k.as_slice(), derived.k.as_slice()),
        ("rim", printed.rim.as_slice(), derived.rim.as_slice()),
    ] {
        assert!(gap(a, b) < tolerance, "{name}: printed {a:?}, derived {b:?}");
    }
}

#[test]
fn the_printed_matrices_follow_from_virtual_work() {
    assert_same(&Matrices::<3>::printed(&THREE_WHEELS), &Matrices::derived(&THREE_WHEELS.generic(THREE_HEADINGS_DEG)));
    assert_same(&Matrices::<4>::printed(&FOUR_WHEELS), &Matrices::derived(&FOUR_WHEELS.generic(FOUR_HEADINGS_DEG)));
}

#[test]
fn equation_33_as_printed_has_one_wrong_sign() {
    let derived = Matrices::derived(&THREE_WHEELS.generic(THREE_HEADINGS_DEG)).b;
    let printed = eq33_as_printed(&THREE_WHEELS);
    let wrong: Vec<_> =
        (0..9).map(|n| (n / 3, n % 3)).filter(|&at| (printed[at] - derived[at]).abs() > 1e-14).collect();
    assert_eq!(wrong, [(1, 1)], "row of vn, column of wheel 1");
    assert!((printed[(1, 1)] + derived[(1, 1)]).abs() < 1e-14, "the size is right, the sign is not");
    // As printed, wheel 1 would feed on its own motion: B·(Kv·l/r·G) would not be the part of A that brakes.
    let p = Matrices::<3>::printed(&THREE_WHEELS);
    let brake = |b: &Matrix3<f64>| b * p.rim * (THREE_WHEELS.kv * THREE_WHEELS.l / THREE_WHEELS.r);
    let viscous = p.inertia.map(f64::recip).component_mul(&Vector3::from(THREE_WHEELS.viscous));
    let expected = -p.a - Matrix3::from_diagonal(&viscous);
    assert!((brake(&p.b) - expected).amax() < 1e-13);
    assert!((brake(&printed) - expected).amax() > 1.0);
}

/// eᵐ = (e^(m/2ᵏ))^(2ᵏ), the inner one by its series.
fn exponential(m: DMatrix<f64>) -> DMatrix<f64> {
    let halvings = m.norm().log2().ceil().max(0.0) as i32 + 1;
    let small = m / 2.0_f64.powi(halvings);
    let mut term = DMatrix::identity(small.nrows(), small.ncols());
    let mut sum = term.clone();
    // what is left out is below ½²⁰/20!
    for k in 1..20 {
        term = term * &small / f64::from(k);
        sum += &term;
    }
    for _ in 0..halvings {
        sum = &sum * &sum;
    }
    sum
}

#[test]
fn the_flow_is_the_matrix_exponential() {
    let mut rig = THREE_WHEELS.generic([140.0, 280.0, 20.0]);
    rig.wheels[0].distance = 0.11;
    let p = Matrices::derived(&rig);
    let (x0, c) = (Vector3::new(0.4, -0.7, 5.0), Vector3::new(1.0, 2.0, -30.0));
    let flow = Flow::new(&p.a, &p.inertia, &c, &x0);
    for t in [1e-3, 0.05, 1.0, 10.0] {
        // d/dt (x, 1, ∫x) = ⎡A c 0⎤
        //                   ⎢0 0 0⎥·(x, 1, ∫x)
        //                   ⎣1 0 0⎦
        let mut m = DMatrix::<f64>::zeros(7, 7);
        m.view_mut((0, 0), (3, 3)).copy_from(&p.a);
        m.view_mut((0, 3), (3, 1)).copy_from(&c);
        m.view_mut((4, 0), (3, 3)).copy_from(&Matrix3::identity());
        let start = DMatrix::from_column_slice(7, 1, &[x0[0], x0[1], x0[2], 1.0, 0.0, 0.0, 0.0]);
        let end = exponential(m * t) * start;
        // Both carry some ten roundings of a largest entry of 50.
        assert!(gap(flow.at(t).as_slice(), &end.as_slice()[..3]) < 1e-12, "{t} s");
        assert!(gap(flow.integral(t).as_slice(), &end.as_slice()[4..]) < 1e-12, "{t} s");
    }
}

#[test]
fn no_zero_of_a_sum_of_exponentials_hides() {
    // (s − 0.5)(s − 0.499)(s − 0.2) with s = e^{−t}: three zeros, two of them 2 ms apart
    let (a, b, c) = (0.5, 0.499, 0.2);
    let terms = vec![(-3.0, 1.0), (-2.0, -(a + b + c)), (-1.0, a * b + a * c + b * c), (0.0, -a * b * c)];
    let found = zeros(terms, 10.0);
    let expected = [a, b, c].map(|s: f64| -s.ln());
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(gap(&found, &expected) < 1e-9, "{found:?} against {expected:?}");
}
