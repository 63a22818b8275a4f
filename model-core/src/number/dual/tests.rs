use super::*;

type D = Dual<2>;

/// A function of one number, and where to try it.
type One = (&'static str, fn(D) -> D, f64);
/// A function of two numbers, and where to try it.
type Two = (&'static str, fn(D, D) -> D, f64, f64);

/// Both derivatives of `f` at (x, y), by central differences.
fn differences(f: fn(D, D) -> D, x: f64, y: f64) -> [f64; 2] {
    // error h²·f‴/6 ≈ 1e-11 by the step, ε·f/h ≈ 1e-11 by rounding
    let h = 1.0e-5;
    let at = |x, y| f(D::constant(x), D::constant(y)).re;
    [(at(x + h, y) - at(x - h, y)) / (2.0 * h), (at(x, y + h) - at(x, y - h)) / (2.0 * h)]
}

fn assert_derivatives(name: &str, f: fn(D, D) -> D, x: f64, y: f64) {
    let got = f(D::variable(x, 0), D::variable(y, 1)).eps;
    let want = differences(f, x, y);
    for (g, w) in got.into_iter().zip(want) {
        assert!((g - w).abs() <= 1.0e-8 * (1.0 + w.abs()), "{name} at ({x}, {y}): {got:?} against {want:?}");
    }
}

#[test]
fn every_function_of_one_number_has_the_derivative_that_differences_show() {
    let functions: [One; 13] = [
        ("−x", |x| -x, 1.3),
        ("√x", Real::sqrt, 1.7),
        ("eˣ", Real::exp, -0.4),
        ("sin x", |x| x.sin_cos().0, 2.9),
        ("cos x", |x| x.sin_cos().1, -7.3),
        ("|x|", Real::abs, -0.6),
        ("sign x", Real::sign, -0.6),
        ("held, inside", |x| x.clamp(D::constant(-1.0), D::constant(1.0)), 0.3),
        ("held, above", |x| x.clamp(D::constant(-1.0), D::constant(1.0)), 1.3),
        ("held, below", |x| x.clamp(D::constant(-1.0), D::constant(1.0)), -1.3),
        ("x²", |x| x.pow(D::constant(2.0)), 1.2),
        ("2ˣ", |x| D::constant(2.0).pow(x), 1.2),
        ("1/x", |x| D::one() / x, -2.0),
    ];
    for (name, f, x) in functions {
        let got = f(D::variable(x, 0)).eps;
        let h = 1.0e-5;
        let want = (f(D::constant(x + h)).re - f(D::constant(x - h)).re) / (2.0 * h);
        assert!((got[0] - want).abs() <= 1.0e-8 * (1.0 + want.abs()), "{name} at {x}: {got:?} against {want}");
        assert!(got[1] == 0.0, "{name} depends on nothing else");
    }
}

#[test]
fn every_function_of_two_numbers_has_the_derivatives_that_differences_show() {
    let functions: [Two; 10] = [
        ("x + y", |x, y| x + y, 1.3, -0.4),
        ("x − y", |x, y| x - y, 1.3, -0.4),
        ("x·y", |x, y| x * y, 1.3, -0.4),
        ("x/y", |x, y| x / y, 1.3, -0.4),
        ("xʸ", Real::pow, 1.3, -0.4),
        ("atan2, right", |x, y| x.atan2(y), 1.3, 0.4),
        ("atan2, left", |x, y| x.atan2(y), -1.3, -0.4),
        ("max", Real::max, 1.3, -0.4),
        ("min", Real::min, 1.3, -0.4),
        ("x·(x·y − x)", |x, y| x * (x * y - x), 1.3, -0.4),
    ];
    for (name, f, x, y) in functions {
        assert_derivatives(name, f, x, y);
    }
}

#[test]
fn a_composed_expression_obeys_the_chain_rule() {
    assert_derivatives(
        "√(x² + e^(sin y))/(1 + |y|)",
        |x, y| (x * x + y.sin_cos().0.exp()).sqrt() / (D::one() + y.abs()),
        0.8,
        -1.9,
    );
    // ∂/∂x of sin(x·y)² = 2·sin·cos·y, ∂/∂y the same with x
    let (x, y) = (0.7, 1.9);
    let sine = (D::variable(x, 0) * D::variable(y, 1)).sin_cos().0;
    let slope = 2.0 * libm::sin(x * y) * libm::cos(x * y);
    for (g, w) in (sine * sine).eps.into_iter().zip([slope * y, slope * x]) {
        assert!((g - w).abs() <= 4.0 * f64::EPSILON, "{g} against {w}");
    }
}

#[test]
fn product_and_quotient_undo_each_other() {
    let (x, y) = (D { re: 1.3, eps: [0.2, -3.0] }, D { re: -0.7, eps: [5.0, 0.1] });
    let back = (x * y) / y;
    // three roundings of numbers below 20
    assert!((back.re - x.re).abs() < 1.0e-15);
    assert!(back.eps.iter().zip(x.eps).all(|(b, w)| (b - w).abs() < 1.0e-14), "{back:?}");
}

#[test]
fn the_assigning_operators_are_the_plain_ones() {
    let (x, y) = (D { re: 1.3, eps: [0.2, -3.0] }, D { re: -0.7, eps: [5.0, 0.1] });
    let (mut sum, mut difference, mut product, mut quotient) = (x, x, x, x);
    sum += y;
    difference -= y;
    product *= y;
    quotient /= y;
    for (a, b) in [(sum, x + y), (difference, x - y), (product, x * y), (quotient, x / y)] {
        assert!(a.re == b.re && a.eps == b.eps);
    }
}

#[test]
fn a_dual_number_compares_by_its_value_alone() {
    let (a, b) = (D::variable(1.0, 0), D::variable(1.0, 1));
    assert!(a == b && a <= b && a >= b);
    assert!(a.partial_cmp(&b) == Some(Ordering::Equal));
    assert!(D::constant(f64::NAN).partial_cmp(&a).is_none());
    // equal values: max and min both keep the first, as for f64
    assert!(a.max(b).eps == a.eps && a.min(b).eps == a.eps);
}

#[test]
fn what_is_held_at_a_bound_has_the_derivative_of_the_bound() {
    let bound = D::variable(1.0, 1);
    let held = D::variable(3.0, 0).clamp(-bound, bound);
    assert!(held.eps == [0.0, 1.0], "{held:?}");
    let held = D::variable(-3.0, 0).clamp(-bound, bound);
    assert!(held.eps == [0.0, -1.0], "{held:?}");
}

#[test]
fn a_finite_value_never_has_a_derivative_of_nan() {
    let zero = D::variable(0.0, 0);
    let tiny = D::variable(5.0e-324, 0);
    let some = D::variable(0.5, 1);
    let values = [
        zero.sqrt(),
        (-zero).sqrt(),
        zero.pow(some),
        zero.pow(zero),
        zero.pow(D::constant(2.0)),
        tiny.sqrt(),
        tiny.pow(D::variable(1.0e-3, 1)),
        D::variable(-2.0, 0).pow(D::variable(2.0, 1)),
        zero.atan2(zero),
        tiny.atan2(zero),
        D::variable(-800.0, 0).exp(),
    ];
    for (k, x) in values.into_iter().enumerate() {
        assert!(Real::is_finite(x), "case {k}: {x:?}");
    }
    assert!(zero.sqrt().eps == [0.0; 2] && zero.pow(some).eps == [0.0; 2]);
}

#[test]
fn the_value_of_a_dual_number_depends_on_nothing() {
    let x = D::variable(2.5, 0);
    assert!(x.value().re == 2.5 && x.value().eps == [0.0; 2]);
    assert!(x.index() == 2 && D::default().re == 0.0);
    assert!(D::variable(2.5, 7).eps == [0.0; 2], "there is no parameter 7");
}
