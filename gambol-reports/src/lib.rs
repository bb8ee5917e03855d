//! Pages and pictures of runs.
//!
//! | module | what it does |
//! |---|---|
//! | [`report`] | a run as an HTML page that works offline |
//! | [`sheet`] | a gait as one image: a contact sheet with charts |
//! | [`film`] | gaits side by side as one animated image |
//! | [`dot`] | a champion's net as a drawing |
//! | [`drawing`] | a creature painted in any pose; why a picture cannot be drawn |
//! | [`page`] | what all pages have in common |

pub mod dot;
pub mod drawing;
pub mod film;
pub mod page;
pub mod report;
pub mod sheet;
