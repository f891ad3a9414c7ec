//! Forces over time.

use formats::ForceTable;

/// 0 before the first time, linear in between, 0 after the last: no force goes on for ever. Every
/// component and every time has a size of its own.
#[test]
fn forces_begin_and_end_with_their_table() {
    let text = "time_s,joint,x_n,y_n,z_n\n1,P,2,-3,5\n2,Q,7,0,0\n3,P,4,-9,25\n4,Q,11,1,1\n";
    let table = ForceTable::parse(text, "wind.csv").unwrap();
    let names: Vec<&str> = table.joints().iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["P", "Q"]);
    let at = |time_s: f64| table.joints()[0].1.at(time_s);
    assert_eq!(at(0.999), [0.0; 3]);
    assert_eq!(at(1.0), [2.0, -3.0, 5.0]);
    assert_eq!(at(1.5), [2.5, -4.5, 10.0]);
    assert_eq!(at(3.0), [4.0, -9.0, 25.0]);
    assert_eq!(at(3.001), [0.0; 3]);
    assert_eq!(table.joints()[1].1.at(3.0), [9.0, 0.5, 0.5]);
}
