//! What all requests share.

use crate::secret::Secret;
use axum::http::HeaderValue;
use std::sync::Arc;
use studio::Library;

/// What is needed to answer.
pub(crate) struct Shared {
    pub(crate) library: Arc<Library>,
    pub(crate) secret: Secret,
    /// What a browser calls us, such as `127.0.0.1:4000`.
    pub(crate) hosts: [String; 2],
    /// Where the page may connect to, and nowhere else.
    pub(crate) policy: HeaderValue,
}
