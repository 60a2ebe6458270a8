//! Connections: so many at once, and so patient with each.

use axum_server::accept::Accept;
use futures_util::future::BoxFuture;
use hyper_util::rt::{TokioExecutor, TokioTimer};
use hyper_util::server::conn::auto::Builder;
use std::io::{self, IoSlice};
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::TcpStream;
use tokio_io_timeout::TimeoutStream;
use voussoir::http::quota::{Quota, Share, address_name};

/// What is buffered of a request on its way in, bytes: its head has to fit.
const BUFFER: usize = 16 << 10;

/// Most bytes of a head in HTTP/2, of which one connection may have many.
const HEAD: u32 = 8 << 10;

/// Most requests at once on one connection (HTTP/2).
const STREAMS: u32 = 32;

/// Bytes of bodies that a client may send before they are read: on one connection, and of one request (HTTP/2).
const WINDOW: u32 = 64 << 10;

/// How a client of HTTP/2 begins.
const PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

/// What a client is told when there are too many.
const FULL: &[u8] =
    b"HTTP/1.1 503 Service Unavailable\r\nretry-after: 1\r\nconnection: close\r\ncontent-length: 0\r\n\r\n";

/// So patient and no more with a request's head, and with a client that is not heard of; a client that has said all it will may
/// still read the answer.
pub fn bound(builder: &mut Builder<TokioExecutor>, patience: Duration) {
    let mut http1 = builder.http1();
    http1.timer(TokioTimer::new()).header_read_timeout(patience).half_close(true).max_buf_size(BUFFER);
    let mut http2 = builder.http2();
    http2.timer(TokioTimer::new()).keep_alive_interval(patience).keep_alive_timeout(patience);
    http2.max_concurrent_streams(STREAMS).max_header_list_size(HEAD).max_send_buf_size(BUFFER);
    http2.initial_stream_window_size(WINDOW).initial_connection_window_size(WINDOW);
}

/// Lets connections in.
#[derive(Debug, Clone)]
pub struct Door {
    /// How many.
    pub connections: Quota,
    /// How long one may say nothing at its beginning, or take nothing of an answer.
    pub patience: Duration,
}

impl<S: Send + 'static> Accept<TcpStream, S> for Door {
    type Stream = Pin<Box<Connection>>;
    type Service = S;
    type Future = BoxFuture<'static, io::Result<(Self::Stream, S)>>;

    fn accept(&self, stream: TcpStream, service: S) -> Self::Future {
        let Door { connections, patience } = self.clone();
        Box::pin(async move {
            let client = address_name(stream.peer_addr()?.ip());
            let Ok(share) = connections.take(&client, 1) else {
                stream.writable().await?;
                // Read or not, it is all there is to say.
                let _ = stream.try_write(FULL);
                return Err(io::ErrorKind::QuotaExceeded.into());
            };
            let mut stream = TimeoutStream::new(stream);
            stream.set_write_timeout(Some(patience));
            stream.set_read_timeout(Some(patience));
            Ok((Box::pin(Connection { stream: Box::pin(stream), begun: Some(0), _share: share }), service))
        })
    }
}

/// A connection. It is hung up on when the client takes nothing of an answer for too long, or does not say which HTTP it speaks:
/// once that is known, the server knows how long to wait for what.
#[derive(Debug)]
pub struct Connection {
    stream: Pin<Box<TimeoutStream<TcpStream>>>,
    /// How much of HTTP/2's preface was read; none once it is known which HTTP the client speaks.
    begun: Option<usize>,
    _share: Share,
}

impl AsyncRead for Connection {
    fn poll_read(mut self: Pin<&mut Self>, cx: &mut Context<'_>, buffer: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        ready!(self.stream.as_mut().poll_read(cx, buffer))?;
        if let Some(begun) = self.begun {
            let read = &buffer.filled()[before..];
            let rest = &PREFACE[begun..];
            let same = rest.iter().zip(read).take_while(|(a, b)| a == b).count();
            self.begun = (same == read.len() && same < rest.len()).then_some(begun + same);
            if self.begun.is_none() {
                self.stream.as_mut().set_read_timeout_pinned(None);
            }
        }
        Poll::Ready(Ok(()))
    }
}

impl AsyncWrite for Connection {
    fn poll_write(mut self: Pin<&mut Self>, cx: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        self.stream.as_mut().poll_write(cx, bytes)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bytes: &[IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        self.stream.as_mut().poll_write_vectored(cx, bytes)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        self.stream.as_mut().poll_flush(cx)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        self.stream.as_mut().poll_shutdown(cx)
    }
}
