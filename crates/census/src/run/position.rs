use numerics::Interval;

use crate::run::Census;
use crate::run::equilibrium::Neighbourhood;
use crate::run::equilibrium::ProvenEquilibrium;
use crate::run::plane::cell::Cell;

/// An equilibrium in one vertical plane through the anchors.
///
/// With the anchors on one vertical a circle of equilibria meets the plane X = 0 in two mirror
/// images; both are positions. Otherwise every equilibrium is one position.
#[derive(Debug, Clone, PartialEq)]
pub struct Position {
    /// Number of the equilibrium or circle in the census, from 1.
    pub number: usize,
    /// Whether it is the mirror image of the one that the census lists.
    pub mirrored: bool,
    /// The position, with everything that is proved about it.
    pub equilibrium: ProvenEquilibrium,
}

impl Position {
    /// The positions of an equilibrium with a number, from 1.
    pub(super) fn of(equilibrium: ProvenEquilibrium, number: usize) -> impl Iterator<Item = Self> {
        let image = equilibrium.circle.then(|| equilibrium.mirrored());
        let image = image.map(|equilibrium| Self { number, mirrored: true, equilibrium });
        std::iter::once(Self { number, mirrored: false, equilibrium }).chain(image)
    }

    /// The number, with a prime for a mirror image: `2'`.
    pub fn label(&self) -> String {
        format!("{}{}", self.number, if self.mirrored { "'" } else { "" })
    }
}

impl Census {
    /// The equilibria in one vertical plane, in the order of the census: for anchors on one
    /// vertical both mirror images of each circle, one after the other.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// let labels: Vec<String> = census.positions().map(|position| position.label()).collect();
    /// assert_eq!(labels, ["1", "1'", "2", "2'"]);
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn positions(&self) -> impl Iterator<Item = Position> + '_ {
        let each = self.equilibria.iter().cloned().zip(1..);
        each.flat_map(|(equilibrium, number)| Position::of(equilibrium, number))
    }
}

impl ProvenEquilibrium {
    /// The mirror image in the vertical plane through both anchors across X = 0, for anchors on one
    /// vertical: the turn by 180 degrees about it.
    fn mirrored(&self) -> Self {
        let start = self.joints_m.first().map_or(Interval::ZERO, |joint| joint[1]);
        let joint = |[x, y, z]: &[Interval; 3]| {
            // The anchors stay where they are, to the bit.
            let image = if *y == start { *y } else { start + (start - *y) };
            [*x, image, *z]
        };
        Self {
            pull_n: [-self.pull_n[0], self.pull_n[1]],
            alone_in: self.alone_in.mirrored(),
            angles_rad: self.angles_rad.iter().map(|angle| -*angle).collect(),
            joints_m: self.joints_m.iter().map(joint).collect(),
            multipliers_n: self.multipliers_n.iter().map(|[x, y, z]| [*x, -*y, *z]).collect(),
            ..self.clone()
        }
    }
}

impl Neighbourhood {
    fn mirrored(self) -> Self {
        let cell = Cell { face: self.chart, at: self.at }.mirrored();
        Self { chart: cell.face, at: cell.at }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::check::CheckError;
    use crate::settings::Settings;

    fn census(case: &str) -> Census {
        let problem = model::cases::get(case).unwrap().problem();
        Census::take(&problem, &Settings::default()).unwrap()
    }

    #[test]
    fn a_mirror_image_is_an_equilibrium_with_the_same_energy() {
        let problem = model::cases::paper();
        let mut mirrored = census("three-equal-bars");
        let positions: Vec<Position> = mirrored.positions().collect();
        assert_eq!(positions.len(), mirrored.count_in_plane());
        for pair in positions.chunks(2) {
            let [one, image] = [&pair[0].equilibrium, &pair[1].equilibrium];
            assert_eq!((one.energy_j, &one.signs), (image.energy_j, &image.signs));
            assert!(one.angles_rad.iter().zip(&image.angles_rad).all(|(a, b)| *a == -*b));
            // Both anchors in place, the joints between them on the other side.
            for (k, (a, b)) in one.joints_m.iter().zip(&image.joints_m).enumerate() {
                assert!((a[1].mid() + b[1].mid()).abs() < 1e-15, "joint {k}");
                assert!(a[2] == b[2]);
            }
            assert_eq!(one.joints_m[3], image.joints_m[3]);
            assert!((image.joints_m[1][1].mid() - image.angles_rad[0].mid().sin()).abs() < 1e-15);
        }
        // Whoever lists the images as further circles is caught, though their signed sum is zero.
        let images = positions.into_iter().filter(|position| position.mirrored);
        mirrored.equilibria = images.map(|position| position.equilibrium).collect();
        let quantity = "the side of the circle that is shown";
        let wrong = Err(CheckError::Wrong { number: 1, quantity });
        assert_eq!(mirrored.check(&problem), wrong);
    }

    #[test]
    fn away_from_one_vertical_positions_are_the_equilibria() {
        let census = census("three-bars-off-centre");
        let positions: Vec<Position> = census.positions().collect();
        assert!(positions.iter().all(|position| !position.mirrored));
        let all: Vec<_> = positions.into_iter().map(|position| position.equilibrium).collect();
        assert_eq!(all, census.equilibria);
    }
}
