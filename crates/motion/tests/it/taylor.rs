//! The double pendulum of two equal point masses against its Taylor series in double-double
//! arithmetic (31 digits): the equations for the two angles, which the natural coordinates never
//! see.

use motion::Order;
use numerics::DoubleDouble as Twin;

use crate::common::{G, at_rest, hanging, links, run, string};

fn twin(x: f64) -> Twin {
    Twin::point(x)
}

/// A number as a double.
fn double(x: Twin) -> f64 {
    x.interval().mid()
}

/// The same number, without the bound of what is rounded off in it.
fn unbounded(x: Twin) -> Twin {
    let high = twin(double(x));
    high + twin(double(x - high))
}

const ZERO: Twin = Twin::ZERO;

/// Coefficient `n` of the product of two series.
fn product(a: &[Twin], b: &[Twin], n: usize) -> Twin {
    (0..=n).fold(ZERO, |sum, k| sum + a[k] * b[n - k])
}

/// Coefficients `n` of the sine and cosine of a series, of which those before are known.
fn circular(x: &[Twin], sin: &mut Vec<Twin>, cos: &mut Vec<Twin>, n: usize) {
    let (mut s, mut c) = (ZERO, ZERO);
    for k in 1..=n {
        let part = twin(k as f64) * x[k];
        s = s + part * cos[n - k];
        c = c - part * sin[n - k];
    }
    sin.push(s / twin(n as f64));
    cos.push(c / twin(n as f64));
}

/// Sine and cosine of a number: its series, after nine halvings.
fn circular_at(x: Twin) -> (Twin, Twin) {
    let small = x * twin(1.0 / 512.0);
    let (mut term, mut sin, mut cos) = (twin(1.0), ZERO, ZERO);
    for k in 0..30_u32 {
        let sign = if k % 4 < 2 { twin(1.0) } else { twin(-1.0) };
        if k % 2 == 0 {
            cos = cos + sign * term;
        } else {
            sin = sin + sign * term;
        }
        term = term * small / twin(f64::from(k + 1));
    }
    for _ in 0..9 {
        // sin 2x = 2 sin cos; 1 - cos loses no digits as 2 sin².
        (sin, cos) = (twin(2.0) * sin * cos, twin(1.0) - twin(2.0) * sin * sin);
    }
    (sin, cos)
}

/// Degree of the series: with steps of 1/64 s it is off by 1e-20 after 10 s, of 1/128 s by less
/// than 1e-25 (a test below).
const DEGREE: usize = 24;

/// A step of the series for angles and velocities of two unit masses on unit links.
fn step(state: [Twin; 4], h: Twin) -> [Twin; 4] {
    let (g, two) = (twin(G), twin(2.0));
    let [mut a, mut b, mut u, mut v] = state.map(|x| vec![x]);
    // Sines and cosines of a and of a − b; e = a − b.
    let mut e = vec![a[0] - b[0]];
    let ((sa, ca), (se, ce)) = (circular_at(a[0]), circular_at(e[0]));
    let (mut sa, mut ca, mut se, mut ce) = (vec![sa], vec![ca], vec![se], vec![ce]);
    let mut series: [Vec<Twin>; 7] = std::array::from_fn(|_| Vec::new());
    for n in 0..DEGREE {
        if n > 0 {
            circular(&a, &mut sa, &mut ca, n);
            circular(&e, &mut se, &mut ce, n);
        }
        let [uu, vv, below, first, second, du, dv] = &mut series;
        uu.push(product(&u, &u, n));
        vv.push(product(&v, &v, n));
        // (2 − cos² e) a'' = −2 g sin a + g cos e sin b − sin e (v² + u² cos e), sin b = sin(a −
        // e).
        let sb: Vec<Twin> = (0..=n).map(|m| product(&sa, &ce, m) - product(&ca, &se, m)).collect();
        let one = if n == 0 { two } else { ZERO };
        below.push(one - product(&ce, &ce, n));
        let inner: Vec<Twin> = (0..=n).map(|m| vv[m] + product(uu, &ce, m)).collect();
        first.push(-(two * g * sa[n]) + g * product(&ce, &sb, n) - product(&se, &inner, n));
        // (2 − cos² e) b'' = 2 g cos e sin a − 2 g sin b + sin e (2 u² + v² cos e).
        let inner: Vec<Twin> = (0..=n).map(|m| two * uu[m] + product(vv, &ce, m)).collect();
        second.push(two * g * (product(&ce, &sa, n) - sb[n]) + product(&se, &inner, n));
        // Quotients, coefficient by coefficient.
        let quotient = |above: Twin, before: &[Twin]| {
            let known = (0..n).fold(above, |sum, k| sum - before[k] * below[n - k]);
            known / below[0]
        };
        let (next_u, next_v) = (quotient(first[n], du), quotient(second[n], dv));
        du.push(next_u);
        dv.push(next_v);
        let by = twin((n + 1) as f64);
        a.push(u[n] / by);
        b.push(v[n] / by);
        u.push(next_u / by);
        v.push(next_v / by);
        e.push(a[n + 1] - b[n + 1]);
    }
    [a, b, u, v].map(|x| unbounded(x.iter().rev().fold(ZERO, |sum, c| sum * h + *c)))
}

/// Energy of the two masses from the height of the anchor.
fn energy([a, b, u, v]: [Twin; 4]) -> Twin {
    let ((_, ca), (_, cb), (_, ce)) = (circular_at(a), circular_at(b), circular_at(a - b));
    u * u + twin(0.5) * v * v + u * v * ce - twin(G) * (twin(2.0) * ca + cb)
}

fn taylor(start: [f64; 2], steps_a_second: u32, seconds: u32) -> [Twin; 4] {
    let mut state = [twin(start[0]), twin(start[1]), ZERO, ZERO];
    let h = twin(1.0) / twin(f64::from(steps_a_second));
    for _ in 0..steps_a_second * seconds {
        state = step(state, h);
    }
    state
}

const START: [f64; 2] = [1.0, 1.5];

#[test]
fn the_series_keeps_its_energy_and_does_not_depend_on_its_step() {
    let (coarse, fine) = (taylor(START, 128, 10), taylor(START, 256, 10));
    for (a, b) in coarse.iter().zip(&fine) {
        let apart = double(*a - *b);
        assert!(apart.abs() < 1e-25, "{apart:e}");
    }
    let begin = energy([twin(START[0]), twin(START[1]), ZERO, ZERO]);
    let lost = double(energy(fine) - begin);
    println!("energy lost by the series {lost:e} J");
    assert!(lost.abs() < 1e-27, "{lost:e}");
}

#[test]
fn the_double_pendulum_follows_its_taylor_series() {
    let [a, b, ..] = taylor(START, 64, 10);
    let told = string(&[1.0, 1.0], &[double(a), double(b)]);
    let system = hanging(&links(2), &[1.0, 1.0]);
    let mut pendulum = at_rest(&system, &string(&[1.0, 1.0], &START), Order::Fourth);
    run(&mut pendulum, 10.0, 5e-4);
    let found = pendulum.joints_m();
    let mut worst = 0.0_f64;
    for (found, told) in found.iter().zip(&told) {
        for k in 0..3 {
            worst = worst.max((found[k] - told[k]).abs());
        }
    }
    println!("off by {worst:e} m after 10 s");
    assert!(worst < 1e-9, "{worst:e}");
}
