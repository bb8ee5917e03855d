//! HTTP and web sockets, for this machine alone.

use crate::{downloads, guard::guard, secret::Secret, shared::Shared, socket::socket};
use axum::{Router, http::HeaderValue, middleware, routing::get};
use std::{
    future::IntoFuture,
    net::{Ipv4Addr, SocketAddr},
    sync::Arc,
};
use studio::Library;
use tokio::{
    net::TcpListener,
    runtime::{Builder, Runtime},
};

/// The studio at its address.
pub struct Server {
    runtime: Runtime,
    listener: TcpListener,
    address: SocketAddr,
    shared: Arc<Shared>,
}

/// Why the studio cannot be served.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServerError {
    /// The port is taken, or there is no network.
    #[error("cannot listen on 127.0.0.1, port {port}: {source}{}", if *port == 0 { "" } else { "; choose another with --port" })]
    Bind {
        /// The port that was asked for; 0: any.
        port: u16,
        /// The reason.
        source: std::io::Error,
    },
    /// There are no random numbers for the secret.
    #[error("the system gives no random numbers: {0}")]
    Secret(String),
    /// It broke off.
    #[error("the server broke off: {0}")]
    Io(#[from] std::io::Error),
}

impl Server {
    /// Listens on the loopback address; port 0: any that is free.
    ///
    /// # Errors
    /// If the port is taken.
    pub fn bind(library: Arc<Library>, port: u16) -> Result<Self, ServerError> {
        let runtime = Builder::new_current_thread().enable_all().build()?;
        let failed = |source| ServerError::Bind { port, source };
        let listener = runtime.block_on(TcpListener::bind((Ipv4Addr::LOCALHOST, port))).map_err(failed)?;
        let address = listener.local_addr()?;
        let secret = Secret::new().map_err(|error| ServerError::Secret(error.to_string()))?;
        let hosts = [format!("127.0.0.1:{}", address.port()), format!("localhost:{}", address.port())];
        let policy = format!(
            "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self' ws://{} ws://{}; \
             base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
            hosts[0], hosts[1]
        );
        // Digits and letters alone.
        let policy = HeaderValue::from_str(&policy).unwrap_or(HeaderValue::from_static("default-src 'none'"));
        let shared = Arc::new(Shared { library, secret, hosts, policy });
        Ok(Self { runtime, listener, address, shared })
    }

    /// Where the page is, secret and all.
    pub fn url(&self) -> String {
        format!("http://{}/{}/", self.address, self.shared.secret.as_str())
    }

    /// Serves until `wait` comes back; then saves and ends all runs.
    ///
    /// # Errors
    /// If the socket breaks.
    pub fn run(self, wait: impl FnOnce() + Send + 'static) -> Result<(), ServerError> {
        let Self { runtime, listener, shared, .. } = self;
        let library = Arc::clone(&shared.library);
        let router = Router::new()
            .route("/{secret}/", get(downloads::index))
            .route("/{secret}/studio.js", get(downloads::script))
            .route("/{secret}/studio.css", get(downloads::style))
            .route("/{secret}/socket", get(socket))
            .route("/{secret}/runs/{run}/{*wanted}", get(downloads::download))
            .layer(middleware::from_fn_with_state(Arc::clone(&shared), guard))
            .with_state(shared);
        let served = runtime.block_on(async move {
            let serving = axum::serve(listener, router);
            // Sockets stay open as long as pages do: they are not waited for.
            tokio::select! {
                ended = serving.into_future() => ended,
                _ = tokio::task::spawn_blocking(wait) => Ok(()),
            }
        });
        // What is still being answered is not waited for.
        runtime.shutdown_background();
        library.close();
        Ok(served?)
    }
}
