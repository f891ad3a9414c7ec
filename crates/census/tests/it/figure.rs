//! The figure of a census, every coordinate of it by hand.

use crate::support::{census, problem};

/// Two bars of 5 m between level anchors 6 m apart hang 4 m deep or stand 4 m high: 170 px for 8 m
/// are 21.25 px for a metre. Panels are 150 px and twice the margin of 18 px wide, their middle is
/// that of the anchors, 3 m from each; the two are centred in the least width, 560 px.
#[test]
fn two_bars_are_drawn_to_the_hundredth_of_a_pixel() {
    let census = census(&problem(&[(5.0, 1.0, 2.5); 2], [6.0, 0.0, 0.0]));
    let expected = include_str!("figure.svg");
    assert_eq!(census.figure("a hanger", 60), expected);
}

/// What the key says of bars without force moves what follows by 112 px.
#[test]
fn the_key_has_room_for_bars_without_force() {
    let bars = [(0.9, 1.0, 0.5), (1.0, 2.0, 0.75), (0.4, 1.0, 0.25)];
    let census = census(&problem(&bars, [1.0, 0.0, -0.5]));
    let svg = census.figure("unloaded", 60);
    let key = svg.split_once("<g class=\"key\"").unwrap().1;
    let at = |text: &str| {
        let line = key.lines().find(|line| line.ends_with(&format!(">{text}</text>"))).unwrap();
        line.split('"').nth(1).unwrap()
    };
    let texts = ["tension", "compression", "no force", "anchor", "joint"].map(at);
    assert_eq!(texts, ["62.00", "166.00", "306.00", "386.00", "456.00"]);
    let dashed = key.lines().filter(|line| line.contains("stroke-dasharray")).count();
    assert_eq!(dashed, 1);
}
