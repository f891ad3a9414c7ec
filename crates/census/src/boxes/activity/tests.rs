//! What a cable and a strut do next to their lengths.

use model::Bar;
use model::system::Joint;

use super::*;

/// A member of 8 m between a joint and an anchor, or between two; (2, 3, 6) are 7 m.
#[test]
fn members_act_where_they_bear_more_than_they_are_slack() {
    let told = |kind: Kind, far: f64, borne: f64, held: bool| {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            if held { Joint::anchor("B", [9.0; 3]) } else { Joint::free("B").with_mass(1.0) },
            Joint::free("C").with_mass(1.0),
        ];
        let body = Bar::homogeneous(8.0, 0.0).unwrap();
        let member = Member::bar(0, 1, body).of_kind(kind);
        let members = vec![member, Member::bar(0, 2, body)];
        let system = System::new("one", 10.0, joints, members).unwrap();
        let axial_n = [borne, 10.0];
        let frame = Frame::new(&system, &axial_n);
        let joints_m = [[0.0; 3], [2.0, 3.0, 6.0].map(|x| x * far / 7.0), [0.0, 0.0, -8.0]];
        let axial_n = [borne * frame.force_n, 10.0];
        activities(&system, &frame, &joints_m, &axial_n).map(|all| all[0])
    };
    let (acts, slack) = (Ok(Activity::Acts), Ok(Activity::Slack));
    let degenerate = Err(NoBox::Degenerate { member: 1 });
    let wrong = Err(NoBox::WrongSign { member: 1 });
    for far in [7.0, 8.0, 9.0] {
        for borne in [-1.0, 0.0, 1.0] {
            assert_eq!(told(Kind::Bar, far, borne, false), acts);
            assert_eq!(told(Kind::Cable, far, borne, true), Ok(Activity::Idle));
        }
    }
    let shorter = |part: f64| 8.0 * (1.0 - part);
    let longer = |part: f64| 8.0 * (1.0 + part);
    assert_eq!(told(Kind::Cable, 8.0, 0.5, false), acts);
    assert_eq!(told(Kind::Cable, 9.0, 0.5, false), acts);
    assert_eq!(told(Kind::Cable, 7.0, 0.0, false), slack);
    assert_eq!(told(Kind::Cable, 7.0, 0.25, false), acts);
    assert_eq!(told(Kind::Cable, 7.0, 0.0625, false), slack);
    assert_eq!(told(Kind::Strut, 8.0, -0.5, false), acts);
    assert_eq!(told(Kind::Strut, 7.0, -0.5, false), acts);
    assert_eq!(told(Kind::Strut, 9.0, 0.0, false), slack);
    assert_eq!(told(Kind::Strut, 9.0, -0.0625, false), slack);
    assert_eq!(told(Kind::Strut, 9.0, -0.25, false), acts);
    // A billionth is neither.
    assert_eq!(told(Kind::Cable, 8.0, 2e-9, false), acts);
    assert_eq!(told(Kind::Cable, 8.0, 0.5e-9, false), degenerate);
    assert_eq!(told(Kind::Cable, shorter(2e-9), 0.0, false), slack);
    assert_eq!(told(Kind::Cable, shorter(0.5e-9), 0.0, false), degenerate);
    assert_eq!(told(Kind::Strut, longer(2e-9), 0.0, false), slack);
    assert_eq!(told(Kind::Strut, longer(0.5e-9), 0.0, false), degenerate);
    assert_eq!(told(Kind::Strut, 8.0, -2e-9, false), acts);
    assert_eq!(told(Kind::Strut, 8.0, -0.5e-9, false), degenerate);
    // Nor is it a wrong sign, and two are.
    assert_eq!(told(Kind::Cable, 7.0, -0.5e-9, false), slack);
    assert_eq!(told(Kind::Cable, 7.0, -2e-9, false), wrong);
    assert_eq!(told(Kind::Strut, 9.0, 0.5e-9, false), slack);
    assert_eq!(told(Kind::Strut, 9.0, 2e-9, false), wrong);
}
