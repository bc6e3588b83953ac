//! The class as pages in the style of the report: one that can be projected, and one for course staff alone.

mod checks;
mod class_page;
mod groups;
mod head;
mod losses;
mod names;
mod points;
mod shown;
mod staff_page;
mod strip;

pub use self::class_page::class_page;
pub use self::head::PageHead;
pub use self::names::{NamedStudent, named_students};
pub use self::staff_page::staff_page;
