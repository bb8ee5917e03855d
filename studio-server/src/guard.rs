//! Refuses requests that do not come from the studio's own page.

use crate::shared::Shared;
use axum::{
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};
use std::sync::Arc;

/// Answers a request that has the secret in its path, our name as its host, and our page as its origin.
pub(crate) async fn guard(State(shared): State<Arc<Shared>>, request: Request, next: Next) -> Response {
    let secret = request.uri().path().split('/').nth(1).unwrap_or_default();
    let is_ours = has_our_name(&shared, request.headers()) && comes_from_us(&shared, request.headers());
    if !is_ours || !shared.secret.is(secret) {
        return (StatusCode::FORBIDDEN, "this studio is open to the page whose address its program shows\n")
            .into_response();
    }
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    headers.insert(header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(header::REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    // A report has a policy of its own.
    headers.entry(header::CONTENT_SECURITY_POLICY).or_insert_with(|| shared.policy.clone());
    response
}

/// The name as a browser writes it that leaves out the usual port.
fn with_port(name: &str) -> String {
    if name.contains(':') { name.to_owned() } else { format!("{name}:80") }
}

/// Another name would be one that somebody else lets lead here.
fn has_our_name(shared: &Shared, headers: &HeaderMap) -> bool {
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok());
    host.is_some_and(|host| shared.hosts.contains(&with_port(host)))
}

fn comes_from_us(shared: &Shared, headers: &HeaderMap) -> bool {
    let Some(origin) = headers.get(header::ORIGIN) else {
        // Browsers say where a socket comes from.
        return !headers.contains_key(header::UPGRADE);
    };
    let name = origin.to_str().ok().and_then(|origin| origin.strip_prefix("http://"));
    name.is_some_and(|name| shared.hosts.contains(&with_port(name)))
}
