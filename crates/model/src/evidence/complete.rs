//! The rung `complete`.

use serde::Serialize;

use super::text::ordinal;

/// A census has listed every equilibrium, and this is one of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Complete {
    /// Equilibria in one vertical plane.
    pub in_plane: usize,
    /// Families of equilibria with slack bars besides.
    pub families: usize,
    /// Patterns of tension and compression that were excluded everywhere else.
    pub patterns: u64,
    /// Cells of pulls that this took.
    pub cells: u64,
    /// What there is to say besides of the list of a system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub system: Option<CompleteSystem>,
}

/// The list of all equilibria of a system of bars, cables, struts and springs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct CompleteSystem {
    /// Isolated equilibria, each standing for all that free turns make of it.
    pub positions: usize,
    /// Parts that move without each other.
    pub parts: usize,
    /// Members in trees, each of which pulls or pushes whatever the others do.
    pub hanging: usize,
}

/// Why there is no census.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, thiserror::Error)]
#[serde(tag = "because", rename_all = "snake_case")]
#[non_exhaustive]
pub enum NoCensus {
    /// Nobody asked for one.
    #[error("no census was taken (`funicular census` takes one, where there can be one)")]
    NotAsked,
    /// The chain has more bars than the census takes.
    #[error("no census: {bars} bars, and the limit is {limit}")]
    TooManyBars {
        /// Number of bars.
        bars: usize,
        /// The limit.
        limit: usize,
    },
    /// The census refuses its settings.
    #[error("no census: its settings are out of range")]
    Settings,
    /// The system is refused as an equilibrium problem.
    #[error("no census: the system is not an equilibrium problem")]
    Refused,
    /// The joints of a net with several closures have more independent motions than are searched.
    #[error(
        "no census: a net of {closures} closures whose joints move in {motions} independent ways, and the limit is {limit}"
    )]
    Motions {
        /// Members less joints that move, without the trees.
        closures: usize,
        /// Independent motions of the joints, but for those that follow from their neighbours.
        motions: usize,
        /// The limit.
        limit: usize,
    },
    /// The list of a net leaves boxes of places of its joints undecided.
    #[error("{boxes} boxes of places of the joints of a net are undecided")]
    Undecided {
        /// How many.
        boxes: usize,
    },
    /// Only the equilibria of a net in the vertical plane of its anchors are listed.
    #[error(
        "the list is complete among the configurations in the vertical plane of the anchors; no others were looked for"
    )]
    PlaneOnly,
    /// A net has a part that turns freely about the vertical through a joint: its equilibria are
    /// circles.
    #[error("no census: what hangs at the {} joint turns freely about the vertical", ordinal(*joint))]
    Turns {
        /// The joint, from 1.
        joint: usize,
    },
    /// A net with several closures has more joints than are searched, or more members than its
    /// joints need to be held: its forces are a family.
    #[error(
        "no census: {closures} independent closures in one part, with more joints than are searched or self-stresses"
    )]
    Closures {
        /// Members less joints that move, without the trees.
        closures: usize,
    },
    /// A chain between anchors bears a force that is not straight down.
    #[error("no census: the {} joint of a chain between anchors bears a force that is not straight down", ordinal(*joint))]
    LoadsNotDown {
        /// The joint that feels it, from 1.
        joint: usize,
    },
    /// A member is elastic, in a chain between anchors or where nothing inextensible bounds the places of its joints.
    #[error(
        "no census: member {member} is elastic, in a chain between anchors or between joints that nothing \
         inextensible bounds"
    )]
    Elastic {
        /// The member, from 1.
        member: usize,
    },
    /// A member of a tree is not proved to bear a force, and may point anywhere; or a cable, strut or rope may be
    /// slack and taut.
    #[error(
        "no census: member {member} bears nothing that is proved to turn it, and may point anywhere or be slack \
         and taut"
    )]
    Limp {
        /// The member, from 1.
        member: usize,
    },
    /// The members that hold a joint may lie flat in a line or plane, or nothing may pull it aside.
    #[error("no census: the members that hold the {} joint may lie flat, or nothing pulls it aside", ordinal(*joint))]
    Flat {
        /// The joint, from 1.
        joint: usize,
    },
    /// There is a floor, which no census knows.
    #[error("no census: systems with a floor are not handled")]
    Floor,
    /// A joint slides on a line, or in a plane and is no part of a chain or tree there.
    #[error(
        "no census: the {} joint slides, or is held to a plane in a net: in one plane only chains and trees have one, \
         in the vertical plane of their anchors and loads; without `plane` a net may have one", ordinal(*joint)
    )]
    Slider {
        /// The joint, from 1.
        joint: usize,
    },
    /// Of cables and ropes alone an equilibrium that is verified is the only one; none is verified.
    #[error(
        "no census: of cables and ropes alone a verified equilibrium is the only one, and none is verified"
    )]
    Cables,
    /// Where cables, struts or ropes are slack nothing holds a joint that no load acts on: it may be anywhere.
    #[error("no census: nothing holds the {} joint, which bears no load, where members are slack", ordinal(*joint))]
    Loose {
        /// The joint, from 1.
        joint: usize,
    },
    /// More sets of cables, struts and ropes may be slack, or of ropes jam, than are tried.
    #[error(
        "no census: its cables, struts and ropes may be slack or jam in more than {limit} ways"
    )]
    SlackSets {
        /// The limit.
        limit: usize,
    },
    /// The system has more equilibria than are listed.
    #[error("no census: more than {limit} equilibria")]
    TooManyPositions {
        /// The limit.
        limit: usize,
    },
}

impl NoCensus {
    /// The joint that it is about, from 1.
    pub fn joint(&self) -> Option<usize> {
        match *self {
            Self::Turns { joint }
            | Self::LoadsNotDown { joint }
            | Self::Flat { joint }
            | Self::Slider { joint }
            | Self::Loose { joint } => Some(joint),
            _ => None,
        }
    }

    /// The member that it is about, from 1.
    pub fn member(&self) -> Option<usize> {
        match *self {
            Self::Elastic { member } | Self::Limp { member } => Some(member),
            _ => None,
        }
    }
}
