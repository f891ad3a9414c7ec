//! Conversions into a type, without the lines around each.

/// Conversions into a type: from which, the name of its value, and what becomes of it.
///
/// ```
/// struct Metres(f64);
/// model::conversions! { Metres: f64, metres => Self(metres); i32, whole => Self(whole.into()); }
/// assert_eq!(Metres::from(2).0, 2.0);
/// ```
#[macro_export]
macro_rules! conversions {
    ($into:ty: $($from:ty, $value:ident => $made:expr;)*) => {$(
        impl From<$from> for $into {
            fn from($value: $from) -> Self {
                $made
            }
        }
    )*};
}
