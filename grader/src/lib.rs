//! Lab and submission in, graded run out. No terminal, no clock, no process: what must not differ between machines lives here.
pub mod controller;
pub mod grade;
pub mod graded;
pub mod verdict;
