//! Chains to bound, and what is needed to check a bound without knowing how it was found.

use model::{Anchors, Bar, Chain, Problem, Vector};
use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use samples::{General, Line};

pub fn rng(stream: u64) -> ChaCha8Rng {
    samples::stream(20_261_121, stream)
}

/// A unit vector, every direction alike.
pub fn direction(rng: &mut impl Rng) -> Vector {
    loop {
        let v: Vector = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
        let size = norm(v);
        if size > 0.1 && size < 1.0 {
            return v.map(|x| x / size);
        }
    }
}

pub fn norm(v: Vector) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

/// A chain of n different bars with a span of at most `slack` of its length; every third one has
/// its anchors on one vertical.
pub fn chain(n: usize, stream: u64, slack: f64) -> Problem {
    let line = if stream.is_multiple_of(3) { Line::Vertical } else { Line::Any };
    General { span: 0.0..slack, line, ..General::default() }.problem(&mut rng(stream), n)
}

/// Weight times length, J: the unit of an energy.
pub fn unit_j(problem: &Problem) -> f64 {
    let chain = problem.chain();
    chain.total_mass_kg() * chain.gravity_m_s2() * chain.total_length_m()
}

/// Energy from the centres of weight, J, measured from joint 0.
pub fn energy(problem: &Problem, joints: &[Vector]) -> f64 {
    let chain = problem.chain();
    let terms = chain.bars().iter().zip(joints.windows(2)).map(|(bar, ends)| {
        let lever = bar.centre_m() / bar.length_m();
        let height = ends[0][2] + lever * (ends[1][2] - ends[0][2]) - joints[0][2];
        bar.mass_kg() * chain.gravity_m_s2() * height
    });
    terms.sum()
}

/// A configuration at random: all bars but two point anywhere, the last two close the chain, turned
/// about the line between their ends.
pub fn configuration(problem: &Problem, rng: &mut impl Rng) -> Vec<Vector> {
    let chain = problem.chain();
    let lengths: Vec<f64> = chain.bars().iter().map(Bar::length_m).collect();
    let n = lengths.len();
    let (first, second) = (lengths[n - 2], lengths[n - 1]);
    loop {
        let mut joints = vec![chain.anchors().start_m];
        for length in &lengths[..n - 2] {
            let (here, towards) = (joints[joints.len() - 1], direction(rng));
            joints.push(std::array::from_fn(|k| here[k] + length * towards[k]));
        }
        let here = joints[n - 2];
        let rest = minus(chain.anchors().end_m, here);
        let gap = norm(rest);
        if gap > first + second || gap < (first - second).abs() || gap < 1e-9 {
            continue;
        }
        // The joint lies `along` the way and `aside` of it.
        let along = (gap * gap + first * first - second * second) / (2.0 * gap);
        let aside = (first * first - along * along).max(0.0).sqrt();
        let axis = rest.map(|x| x / gap);
        let any = direction(rng);
        let on_axis = any[0] * axis[0] + any[1] * axis[1] + any[2] * axis[2];
        let across: Vector = std::array::from_fn(|k| any[k] - on_axis * axis[k]);
        let size = norm(across);
        if size < 1e-3 {
            continue;
        }
        joints.push(std::array::from_fn(|k| here[k] + along * axis[k] + aside / size * across[k]));
        joints.push(chain.anchors().end_m);
        return joints;
    }
}

/// The same chain in other units of length, mass and gravity.
pub fn scaled(problem: &Problem, length: f64, mass: f64, gravity: f64) -> Problem {
    let chain = problem.chain();
    let anchors = Anchors {
        start_m: chain.anchors().start_m.map(|x| length * x),
        end_m: chain.anchors().end_m.map(|x| length * x),
    };
    let bars = chain
        .bars()
        .iter()
        .map(|bar| {
            let (l, r) = (length * bar.length_m(), length * bar.centre_m());
            Bar::new(l, mass * bar.mass_kg(), r.min(l), [0.0; 3]).unwrap()
        })
        .collect();
    let g = gravity * chain.gravity_m_s2();
    Problem::new(Chain::new("scaled", g, anchors, bars).unwrap()).unwrap()
}
