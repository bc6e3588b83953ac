//! The class as pages in the style of the report: one that can be projected, one for course staff alone, and the list of the whole book.

mod book_page;
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

pub use self::book_page::{BookList, LabPages, book_page};
pub use self::class_page::class_page;
pub use self::head::PageHead;
pub use self::names::{NamedStudent, SORTED_TABLE, named_students};
pub use self::staff_page::{StaffPage, staff_page};
