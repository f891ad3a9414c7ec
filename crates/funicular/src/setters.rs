//! Methods of builders.

/// Methods that set one value each: the field of their name.
macro_rules! setters {
    ($($(#[$about:meta])* $name:ident: $kind:ty $(=> $value:expr)?,)*) => {$(
        $(#[$about])*
        #[must_use]
        pub fn $name(self, $name: $kind) -> Self {
            $(let $name = $value;)?
            Self { $name, ..self }
        }
    )*};
}
