//! Messages of JSON-RPC 2.0, as the Model Context Protocol and the Language Server Protocol send them.

use serde::Serialize;
use serde_json::{Value, json};
use std::io::{self, BufRead, Read, Write};
use std::sync::{Mutex, PoisonError};

/// The text is no JSON.
pub const PARSE_ERROR: i64 = -32_700;
/// The JSON is no message.
pub const INVALID_REQUEST: i64 = -32_600;
/// There is no such method.
pub const METHOD_NOT_FOUND: i64 = -32_601;
/// The method does not take such parameters.
pub const INVALID_PARAMS: i64 = -32_602;
/// The server cannot answer at present.
pub const SERVER_BUSY: i64 = -32_000;
/// The handshake is missing, of the Language Server Protocol.
pub const NOT_INITIALIZED: i64 = -32_002;
/// The request was cancelled, of the Language Server Protocol.
pub const REQUEST_CANCELLED: i64 = -32_800;
/// The text has changed since the request, of the Language Server Protocol.
pub const CONTENT_MODIFIED: i64 = -32_801;

/// An error of the protocol, as a response carries it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Error {
    pub code: i64,
    pub message: String,
}

impl Error {
    pub fn new(code: i64, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code, message }
    }

    /// An error in the parameters of a method.
    pub fn params(message: impl Into<String>) -> Self {
        Self::new(INVALID_PARAMS, message)
    }

    /// The error that a server has no such method.
    pub fn method(method: &str) -> Self {
        Self::new(METHOD_NOT_FOUND, format!("there is no method `{method}`"))
    }
}

/// A message that a client sends.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// A message that asks for a response.
    Request { id: Value, method: String, params: Value },
    /// A message that has no response.
    Notification { method: String, params: Value },
    /// A response to a request of the server.
    Response,
}

impl Message {
    /// Parses the JSON of a message.
    ///
    /// # Errors
    /// The response that says what is wrong with it.
    pub fn read(mut value: Value) -> Result<Self, Value> {
        let id = value.get("id").filter(|id| id.is_string() || id.is_number()).cloned();
        let named = id.clone().unwrap_or(Value::Null);
        let invalid = |message: &str| Err(failure(&named, &Error::new(INVALID_REQUEST, message)));
        if !value.is_object() {
            return invalid("a message is a JSON object");
        }
        if value.get("jsonrpc").and_then(Value::as_str) != Some("2.0") {
            return invalid("`jsonrpc` should be \"2.0\"");
        }
        let Some(method) = value.get("method") else {
            return match value.get("result").or(value.get("error")) {
                Some(_) => Ok(Self::Response),
                None => invalid("`method` is missing"),
            };
        };
        let Some(method) = method.as_str().map(str::to_owned) else {
            return invalid("`method` should be a string");
        };
        let params = value.get_mut("params").map_or(Value::Null, Value::take);
        if !(params.is_null() || params.is_object() || params.is_array()) {
            return invalid("`params` should be an object");
        }
        match (id, value.get("id")) {
            (Some(id), _) => Ok(Self::Request { id, method, params }),
            (None, None) => Ok(Self::Notification { method, params }),
            (None, Some(_)) => invalid("`id` should be a string or a number"),
        }
    }
}

/// Returns the response to a request with this result.
pub fn success(id: &Value, result: Value) -> Value {
    json!({ "jsonrpc": "2.0", "id": id, "result": result })
}

/// Returns the response to a request that failed.
pub fn failure(id: &Value, error: &Error) -> Value {
    json!({ "jsonrpc": "2.0", "id": id, "error": error })
}

/// Returns a notification of the server.
pub fn notification(method: &str, params: Value) -> Value {
    json!({ "jsonrpc": "2.0", "method": method, "params": params })
}

/// A frame of a stream of messages, of bounded length.
#[derive(Debug, PartialEq, Eq)]
pub enum Frame {
    Whole(Vec<u8>),
    /// More bytes than are read; they are skipped.
    TooLong,
    /// A header without a length of the message.
    NoLength,
}

/// Reads a line without its line break; `None` at the end of the input.
///
/// # Errors
/// The input cannot be read.
pub fn line(input: &mut dyn BufRead, most: usize) -> io::Result<Option<Frame>> {
    let (mut line, mut is_long, mut is_met) = (Vec::new(), false, false);
    loop {
        let part = match input.fill_buf() {
            Ok(part) => part,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        if part.is_empty() {
            break;
        }
        is_met = true;
        let end = part.iter().position(|&byte| byte == b'\n');
        let own = part.get(..end.unwrap_or(part.len())).unwrap_or_default();
        is_long |= line.len() + own.len() > most;
        if is_long {
            line = Vec::new();
        } else {
            line.extend_from_slice(own);
        }
        let used = own.len() + usize::from(end.is_some());
        input.consume(used);
        if end.is_some() {
            break;
        }
    }
    Ok(match (is_met, is_long) {
        (false, _) => None,
        (true, true) => Some(Frame::TooLong),
        (true, false) => Some(Frame::Whole(line)),
    })
}

/// The longest line of a header, in bytes.
const LONGEST_HEADER: usize = 4096;

/// Reads a message behind a header with its length; `None` at the end of the input.
///
/// # Errors
/// The input cannot be read.
pub fn message(input: &mut dyn BufRead, most: usize) -> io::Result<Option<Frame>> {
    let mut length: Option<u64> = None;
    loop {
        let header = match line(input, LONGEST_HEADER)? {
            None => return Ok(None),
            Some(Frame::Whole(header)) => String::from_utf8_lossy(&header).trim().to_owned(),
            Some(_) => continue,
        };
        if header.is_empty() {
            break;
        }
        if let Some((name, value)) = header.split_once(':')
            && name.trim().eq_ignore_ascii_case("content-length")
        {
            length = value.trim().parse().ok();
        }
    }
    let Some(length) = length else {
        return Ok(Some(Frame::NoLength));
    };
    let mut body = input.take(length);
    if length > most as u64 {
        io::copy(&mut body, &mut io::sink())?;
        return Ok(Some(Frame::TooLong));
    }
    let mut bytes = Vec::new();
    body.read_to_end(&mut bytes)?;
    // a message that is cut off ends the input
    Ok((bytes.len() as u64 == length).then_some(Frame::Whole(bytes)))
}

/// The output of a server, which several threads write to, a whole message each time.
pub struct Out {
    to: Mutex<Box<dyn Write + Send>>,
    has_length: bool,
}

impl Out {
    /// An output with a message in each line.
    pub fn lines(to: impl Write + Send + 'static) -> Self {
        let to: Box<dyn Write + Send> = Box::new(to);
        Self {
            to: Mutex::new(to),
            has_length: false,
        }
    }

    /// An output with a header before each message.
    pub fn with_lengths(to: impl Write + Send + 'static) -> Self {
        let has_length = true;
        Self {
            has_length,
            ..Self::lines(to)
        }
    }

    /// Writes a message. A client that reads no more ends its input too, which ends the server.
    pub fn send(&self, message: &Value) {
        let text = message.to_string();
        let mut to = self.to.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = match self.has_length {
            true => write!(to, "Content-Length: {}\r\n\r\n{text}", text.len()),
            false => writeln!(to, "{text}"),
        };
        let _ = to.flush();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_a_request_a_notification_or_a_response() {
        let read = |text: &str| Message::read(serde_json::from_str(text).unwrap());
        let request = read(r#"{"jsonrpc":"2.0","id":"a","method":"ping"}"#).unwrap();
        let params = Value::Null;
        let (id, method) = ("a".into(), "ping".to_owned());
        assert_eq!(request, Message::Request { id, method, params });
        let notification = read(r#"{"jsonrpc":"2.0","method":"x","params":{}}"#).unwrap();
        assert!(matches!(notification, Message::Notification { .. }));
        assert_eq!(read(r#"{"jsonrpc":"2.0","id":1,"result":{}}"#), Ok(Message::Response));
        for (text, id) in [
            ("3", Value::Null),
            ("[]", Value::Null),
            (r#"{"id":1,"method":"ping"}"#, 1.into()),
            (r#"{"jsonrpc":"2.0","id":1}"#, 1.into()),
            (r#"{"jsonrpc":"2.0","id":1,"method":2}"#, 1.into()),
            (r#"{"jsonrpc":"2.0","id":null,"method":"ping"}"#, Value::Null),
            (r#"{"jsonrpc":"2.0","id":1,"method":"ping","params":3}"#, 1.into()),
        ] {
            let response = read(text).unwrap_err();
            assert_eq!(
                (&response["id"], &response["error"]["code"]),
                (&id, &INVALID_REQUEST.into()),
                "{text}"
            );
        }
    }

    #[test]
    fn a_message_has_the_length_that_its_header_says() {
        let text = "Content-Length: 2\r\n\r\n{}content-length:3\nX: y\n\n[1]nonsense\n\n\
                    Content-Length: 9\r\n\r\n123456789Content-Length: 4\r\n\r\n12";
        let mut input = text.as_bytes();
        let mut next = || message(&mut input, 5).unwrap();
        assert_eq!(next(), Some(Frame::Whole(b"{}".to_vec())));
        assert_eq!(next(), Some(Frame::Whole(b"[1]".to_vec())));
        assert_eq!(next(), Some(Frame::NoLength));
        assert_eq!(next(), Some(Frame::TooLong));
        assert_eq!(next(), None);
    }

    #[test]
    fn a_line_that_is_too_long_is_skipped_and_the_next_one_is_read() {
        let text = b"abc\n0123456789\n\nend".to_vec();
        let mut input = io::BufReader::with_capacity(4, text.as_slice());
        let mut next = || line(&mut input, 5).unwrap();
        assert_eq!(next(), Some(Frame::Whole(b"abc".to_vec())));
        assert_eq!(next(), Some(Frame::TooLong));
        assert_eq!(next(), Some(Frame::Whole(Vec::new())));
        assert_eq!(next(), Some(Frame::Whole(b"end".to_vec())));
        assert_eq!(next(), None);
    }
}
