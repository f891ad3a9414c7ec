use model::Problem;
use model::system::System;

use crate::parameter::apply::PointError;
use crate::parameter::base::{check, resolved};
use crate::parameter::error::{ParameterError, Result};
use crate::parameter::number::Number;
use crate::parameter::system::{self, Unchecked};
use crate::parameter::values::{MAX_POINTS, Parameter};

/// How several parameters are combined.
///
/// ```
/// use branches::{Combine, Variation};
/// let vary = ["bars.1.mass_kg=1,2".parse()?, "bars.3.mass_kg=3,4".parse()?];
/// let paths = |combine| {
///     let variation = Variation::new(model::cases::paper().chain(), &vary, combine);
///     variation.map(|variation| variation.paths().to_vec())
/// };
/// assert_eq!(paths(Combine::Product)?, [[[1.0, 3.0], [1.0, 4.0]], [[2.0, 3.0], [2.0, 4.0]]]);
/// assert_eq!(paths(Combine::Zip)?, [[[1.0, 3.0], [2.0, 4.0]]]);
/// # Ok::<(), branches::ParameterError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Combine {
    /// Every value of each with every value of the others; the last one changes fastest.
    #[default]
    Product,
    /// The first values of all, the second values of all, and so on.
    Zip,
}

/// A system with parameters: a list of paths, each a row of points.
///
/// Along a path the branches of equilibria are followed. In a product the last parameter runs along
/// the path, and each combination of the others has a path of its own; in step there is one path.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    base: System,
    numbers: Vec<Number>,
    /// The same by their own names.
    resolved: Vec<Number>,
    /// For each path, for each point, for each number.
    paths: Vec<Vec<Vec<f64>>>,
}

impl Variation {
    /// The variation of a system over parameters.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] when a bar or a joint is missing, a number is named twice, lists to be
    /// taken in step differ in length, a range has no number of points, or there are more than
    /// [`MAX_POINTS`] points.
    ///
    /// ```
    /// use branches::{Combine, Variation};
    /// let paper = model::cases::paper();
    /// let vary = ["bars.2.mass_kg=1,2,3".parse()?, "anchors.end_m.z=-2.5..-0.5:5".parse()?];
    /// let variation = Variation::new(paper.chain(), &vary, Combine::Product)?;
    /// assert_eq!((variation.paths().len(), variation.paths()[0].len()), (3, 5));
    /// assert!(Variation::new(paper.chain(), &vary, Combine::Zip).is_err());
    /// # Ok::<(), branches::ParameterError>(())
    /// ```
    pub fn new(base: impl Into<System>, vary: &[Parameter], combine: Combine) -> Result<Self> {
        let base = base.into();
        for one in vary {
            check(&base, one)?;
            one.with_points()?;
        }
        Self::along(base, vary, combine)
    }

    /// The same for paths that find their own points: a range may have no number of them.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn along(base: impl Into<System>, vary: &[Parameter], combine: Combine) -> Result<Self> {
        let base = base.into();
        for (k, one) in vary.iter().enumerate() {
            check(&base, one)?;
            let number = resolved(&base, &one.number);
            let same = |other: &&Parameter| resolved(&base, &other.number).overlaps(&number);
            let earlier = vary[..k].iter().find(same);
            if let Some(earlier) = earlier {
                let what = if earlier.number == one.number {
                    format!("`{}` is varied twice", one.number)
                } else {
                    format!("`{}` and `{}` set one number", earlier.number, one.number)
                };
                let span = 0..one.text().len();
                return Err(ParameterError::new(one.text(), span, what, "name each number once"));
            }
        }
        let numbers = vary.iter().map(|one| one.number.clone()).collect();
        let paths = match combine {
            Combine::Product => product(vary)?,
            Combine::Zip => vec![zip(vary)?],
        };
        let resolved = vary.iter().map(|one| resolved(&base, &one.number)).collect();
        Ok(Self { base, numbers, resolved, paths })
    }

    /// The numbers that vary.
    pub fn numbers(&self) -> &[Number] {
        &self.numbers
    }

    /// The paths: for each point the values of [`numbers`](Self::numbers).
    pub fn paths(&self) -> &[Vec<Vec<f64>>] {
        &self.paths
    }

    /// What has the numbers that vary.
    pub fn base(&self) -> &System {
        &self.base
    }

    /// Whether the system is one row of rigid bars between two anchors under upright loads, and stays
    /// one: all its equilibria can be followed.
    pub fn is_row(&self) -> bool {
        self.base.as_row().is_some() && self.numbers.iter().all(Number::keeps_rows)
    }

    /// The row of bars at some values of the numbers, on or off the grid, as a chain.
    ///
    /// # Errors
    ///
    /// [`PointError`] when the values describe no such problem.
    ///
    /// ```
    /// use branches::{Combine, PointError, Variation};
    /// let vary = ["anchors.end_m.z=-3.1..-0.1:61".parse()?];
    /// let variation = Variation::new(model::cases::paper().chain(), &vary, Combine::Product)?;
    /// assert_eq!(variation.problem(&[-2.5])?.chain().anchors().span_m(), 2.5);
    /// // Three bars of 1 m reach no farther than 3 m.
    /// assert!(variation.problem(&[-3.1]).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn problem(&self, values: &[f64]) -> Result<Problem, PointError> {
        let system = self.system(values)?;
        system.as_row().map(|row| row.problem().clone()).ok_or(PointError::NoRow)
    }

    /// The numbers at some values, whether or not they describe a system.
    pub(crate) fn unchecked(&self, values: &[f64]) -> Unchecked {
        Unchecked::new(&self.base, &self.resolved, values)
    }

    /// The system at some values of the numbers, on or off the grid.
    ///
    /// # Errors
    ///
    /// [`PointError`] when the values describe no system, or one without an equilibrium.
    ///
    /// ```
    /// use branches::{Combine, Variation};
    /// use model::{Bar, system::{Joint, Member, System}};
    /// let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(1.0)];
    /// let members = vec![Member::cable(0, 1, Bar::homogeneous(2.0, 0.0)?)];
    /// let system = System::new("a weight", 9.81, joints, members)?;
    /// let vary = ["joints.P.mass_kg=1,2".parse()?, "bars.1.stiffness_n=100".parse()?];
    /// let variation = Variation::new(system, &vary, Combine::Product)?;
    /// let heavier = variation.system(&[3.0, 50.0])?;
    /// assert_eq!((heavier.joints()[1].mass_kg, heavier.members()[0].stiffness_n), (3.0, Some(50.0)));
    /// assert!(variation.system(&[-1.0, 50.0]).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn system(&self, values: &[f64]) -> Result<System, PointError> {
        system::answerable(self.unloaded(values)?)
    }

    /// The same whether or not the system has an equilibrium, as without its loads.
    ///
    /// # Errors
    ///
    /// [`PointError`] when the values describe no system.
    pub fn unloaded(&self, values: &[f64]) -> Result<System, PointError> {
        system::with_numbers(&self.base, &self.resolved, values)
    }
}

fn too_many(vary: &[Parameter]) -> ParameterError {
    let text = vary.last().map_or("", Parameter::text);
    ParameterError::new(
        text,
        0..text.len(),
        "the parameters have too many combinations",
        format!("at most {MAX_POINTS} points are allowed"),
    )
}

fn product(vary: &[Parameter]) -> Result<Vec<Vec<Vec<f64>>>> {
    let points = vary.iter().try_fold(1_usize, |points, one| points.checked_mul(one.values.len()));
    if points.is_none_or(|points| points > MAX_POINTS) {
        return Err(too_many(vary));
    }
    let Some((along, others)) = vary.split_last() else { return Ok(vec![vec![vec![]]]) };
    let mut fixed: Vec<Vec<f64>> = vec![vec![]];
    for one in others {
        let longer = |head: &Vec<f64>, value: &f64| {
            let mut head = head.clone();
            head.push(*value);
            head
        };
        fixed = fixed
            .iter()
            .flat_map(|head| one.values.iter().map(move |value| longer(head, value)))
            .collect();
    }
    let path = |head: &Vec<f64>| -> Vec<Vec<f64>> {
        let point = |value: &f64| head.iter().copied().chain([*value]).collect();
        along.values.iter().map(point).collect()
    };
    Ok(fixed.iter().map(path).collect())
}

fn zip(vary: &[Parameter]) -> Result<Vec<Vec<f64>>> {
    let length = vary.first().map_or(1, |one| one.values.len());
    for one in vary {
        if one.values.len() != length {
            return Err(ParameterError::new(
                one.text(),
                0..one.text().len(),
                format!("{} values, but `{}` has {length}", one.values.len(), vary[0].number),
                "parameters taken in step need equally many values",
            ));
        }
    }
    Ok((0..length).map(|k| vary.iter().map(|one| one.values[k]).collect()).collect())
}
