//! Elongations against exact numbers.

use model::system::Kind;
use nalgebra::Vector3;

use super::*;

const LINK: Link = Link { from: 0, to: 1, length: 5.0, compliance: 1.0, kind: Kind::Bar };

const NOTHING: Vector3<f64> = Vector3::new(0.0, 0.0, 0.0);

fn state(place: [f64; 3], rest: [f64; 3]) -> State {
    let places = vec![Vector3::zeros(), Vector3::from(place)];
    let mut state = State::new(places, vec![0.0], vec![true]);
    state.rests[1] = Vector3::from(rest);
    state
}

#[test]
fn small_elongations_keep_their_digits() {
    // 3, 4, 0 and a move of e along the member: longer by e, whatever is cut off the places.
    for e in [1e-3, 1e-9, 1e-15, 1e-20, 1e-25] {
        let (x, y) = (two_sum(3.0, 0.6 * e), two_sum(4.0, 0.8 * e));
        let found = elongation(&LINK, &state([x.0, y.0, 0.0], [x.1, y.1, 0.0]), &NOTHING);
        // 0.6 and 0.8 are rounded: 0.36 + 0.64 is one to the last place.
        assert!((found / e - 1.0).abs() < 1e-14, "{e}: {found}");
    }
    // Across by e: longer by e²/10.
    let across = elongation(&LINK, &state([3.0, 4.0, 1e-6], [0.0; 3]), &NOTHING);
    assert!((across / 1e-13 - 1.0).abs() < 1e-12);
    // What is cut off an anchor stands with the member.
    let off = Vector3::new(1e-18, 0.0, 0.0);
    let anchored = elongation(&LINK, &state([5.0, 0.0, 0.0], [0.0; 3]), &off);
    assert!((anchored / 1e-18 - 1.0).abs() < 1e-14);
}
