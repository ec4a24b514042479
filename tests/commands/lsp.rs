//! `lsp`, by a client that is written from the specification of the Language Server Protocol.

use crate::common::program::{program, scratch};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// The time in which any answer comes, on a machine that is busy too.
const LONGEST: Duration = Duration::from_secs(120);

/// The next message of a server.
fn read(input: &mut impl BufRead) -> Option<Value> {
    let mut length = None;
    loop {
        let mut header = String::new();
        if input.read_line(&mut header).ok()? == 0 {
            return None;
        }
        match header.trim_end().split_once(": ") {
            Some(("Content-Length", number)) => length = number.parse().ok(),
            Some(_) => {}
            None => break,
        }
    }
    let mut body = vec![0; length.expect("a length")];
    input.read_exact(&mut body).ok()?;
    Some(serde_json::from_slice(&body).expect("JSON"))
}

/// An editor with a server of its own.
struct Editor {
    server: Child,
    stdin: Option<ChildStdin>,
    messages: Receiver<Value>,
    last: u64,
}

impl Editor {
    /// An editor before the handshake.
    fn new() -> Self {
        let mut command = program(["lsp"]).command();
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        let mut server = command.spawn().expect("the program");
        let (stdin, stdout) = (server.stdin.take(), server.stdout.take().expect("its output"));
        let (send, messages) = channel();
        std::thread::spawn(move || {
            let mut input = BufReader::new(stdout);
            while let Some(message) = read(&mut input) {
                if send.send(message).is_err() {
                    break;
                }
            }
        });
        Self {
            server,
            stdin,
            messages,
            last: 0,
        }
    }

    /// An editor behind the handshake.
    fn ready() -> Self {
        let mut editor = Self::new();
        let capabilities = json!({ "workspace": { "workspaceEdit": { "documentChanges": true } } });
        let result = editor.result(
            "initialize",
            json!({ "processId": null, "rootUri": null, "capabilities": capabilities }),
        );
        assert_eq!(result["capabilities"]["positionEncoding"], "utf-16");
        editor.notify("initialized", json!({}));
        editor
    }

    fn raw(&mut self, text: &str) {
        let stdin = self.stdin.as_mut().expect("an input");
        stdin.write_all(text.as_bytes()).expect("it is read");
        stdin.flush().expect("it is read");
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        self.raw(&format!("Content-Length: {}\r\n\r\n{text}", text.len()));
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn request(&mut self, method: &str, params: Value) -> u64 {
        self.last += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.last, "method": method, "params": params }));
        self.last
    }

    /// The next message that is no log.
    fn next(&mut self) -> Value {
        loop {
            let message = self.messages.recv_timeout(LONGEST).expect("a message");
            assert_eq!(message["jsonrpc"], "2.0");
            if message["method"] != "window/logMessage" {
                return message;
            }
        }
    }

    /// Sends a request, and returns its response; diagnostics before it are left out.
    fn response(&mut self, method: &str, params: Value) -> Value {
        let id = self.request(method, params);
        loop {
            let message = self.next();
            if message["id"] == id {
                return message;
            }
            assert_eq!(message["method"], "textDocument/publishDiagnostics", "{message}");
        }
    }

    #[track_caller]
    fn result(&mut self, method: &str, params: Value) -> Value {
        let response = self.response(method, params);
        assert!(response.get("error").is_none(), "{response}");
        response["result"].clone()
    }

    #[track_caller]
    fn code(&mut self, method: &str, params: Value) -> i64 {
        let response = self.response(method, params);
        response["error"]["code"]
            .as_i64()
            .unwrap_or_else(|| panic!("no error: {response}"))
    }

    fn open(&mut self, uri: &str, language: &str, text: &str) {
        let document = json!({ "uri": uri, "languageId": language, "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    fn change(&mut self, uri: &str, version: i64, text: &str) {
        let document = json!({ "uri": uri, "version": version });
        let params = json!({ "textDocument": document, "contentChanges": [{ "text": text }] });
        self.notify("textDocument/didChange", params);
    }

    /// The diagnostics that are published of a version next.
    #[track_caller]
    fn diagnostics(&mut self, uri: &str, version: i64) -> Vec<Value> {
        let message = self.next();
        let params = &message["params"];
        assert_eq!(message["method"], "textDocument/publishDiagnostics", "{message}");
        assert_eq!((&params["uri"], &params["version"]), (&json!(uri), &json!(version)));
        params["diagnostics"].as_array().expect("a list").clone()
    }

    /// The repairs of the formula at a place.
    fn actions(&mut self, uri: &str, line: u64, character: u64) -> Vec<Value> {
        let place = json!({ "line": line, "character": character });
        let params = json!({
            "textDocument": { "uri": uri },
            "range": { "start": place, "end": place },
            "context": { "diagnostics": [] },
        });
        self.result("textDocument/codeAction", params)
            .as_array()
            .expect("a list")
            .clone()
    }

    fn hover(&mut self, uri: &str, line: u64, character: u64) -> Value {
        let params = json!({ "textDocument": { "uri": uri }, "position": { "line": line, "character": character } });
        self.result("textDocument/hover", params)
    }

    /// Says `exit`, or ends the input; returns the exit status.
    fn end(mut self, says_exit: bool) -> Option<i32> {
        if says_exit {
            self.notify("exit", Value::Null);
        }
        drop(self.stdin.take());
        self.server.wait().expect("an end").code()
    }
}

/// The text behind the edits of an action, by places in UTF-16.
fn applied(text: &str, action: &Value) -> String {
    let units: Vec<Vec<u16>> = text.split('\n').map(|line| line.encode_utf16().collect()).collect();
    let offset = |place: &Value| {
        let number = |key: &str| place[key].as_u64().expect("a number") as usize;
        let (line, character) = (number("line"), number("character"));
        assert!(character <= units[line].len());
        units[..line].iter().map(|line| line.len() + 1).sum::<usize>() + character
    };
    let mut whole: Vec<u16> = text.encode_utf16().collect();
    let edits = action["edit"]["documentChanges"][0]["edits"].as_array().expect("edits");
    for edit in edits.iter().rev() {
        let (start, end) = (offset(&edit["range"]["start"]), offset(&edit["range"]["end"]));
        whole.splice(start..end, edit["newText"].as_str().expect("a text").encode_utf16());
    }
    String::from_utf16(&whole).expect("whole characters")
}

const URI: &str = "file:///nowhere/fall.tex";

/// A slip behind an umlaut and a character of two units, which stand in the line of the formula.
const FALL: &str = "% audit: symbols E, v, h, H; positive m, g
\\begin{equation} E = \\frac{1}{2} m v^2 + m g h \\label{energy} \\end{equation}  % audit: premise
\\begin{equation} E = m g H \\label{rest} \\end{equation}                        % audit: premise
Die Höhe 🏔: \\begin{equation} v^2 = g (H - h) \\end{equation}  % audit: claim; follows from \\eqref{energy}, \\eqref{rest}
";

#[test]
fn a_slip_is_marked_and_repaired_by_a_quick_fix() {
    let mut editor = Editor::ready();
    editor.open(URI, "latex", FALL);
    let found = editor.diagnostics(URI, 1);
    assert_eq!(found.len(), 1, "{found:?}");
    let line: Vec<u16> = FALL.lines().nth(3).unwrap().encode_utf16().collect();
    let range = &found[0]["range"];
    let [start, end] = ["start", "end"].map(|end| range[end]["character"].as_u64().unwrap() as usize);
    assert_eq!(
        (range["start"]["line"].as_u64(), range["end"]["line"].as_u64()),
        (Some(3), Some(3))
    );
    assert_eq!(String::from_utf16(&line[start..end]).unwrap(), "v^2 = g (H - h)");
    assert_eq!(
        (&found[0]["severity"], &found[0]["code"], &found[0]["source"]),
        (&json!(1), &json!("refuted"), &json!("vibro-audit"))
    );
    assert!(
        found[0]["message"].as_str().unwrap().contains("counterexample: E=0"),
        "{found:?}"
    );
    // the repairs follow
    let found = editor.diagnostics(URI, 1);
    assert!(
        found[0]["message"].as_str().unwrap().contains("factor `2` is missing"),
        "{found:?}"
    );
    let hover = editor.hover(URI, 3, start as u64 + 2);
    let said = hover["contents"]["value"].as_str().unwrap();
    assert!(
        said.starts_with("(3) refuted") && said.contains("digits: 0.6"),
        "{said}"
    );
    assert_eq!(&hover["range"], range);
    assert_eq!(editor.hover(URI, 0, 3), Value::Null);
    let actions = editor.actions(URI, 3, start as u64);
    assert_eq!(
        (&actions[0]["kind"], &actions[0]["isPreferred"]),
        (&json!("quickfix"), &json!(true))
    );
    assert_eq!(actions[0]["diagnostics"][0]["code"], "refuted");
    assert_eq!(
        actions[0]["edit"]["documentChanges"][0]["textDocument"],
        json!({ "uri": URI, "version": 1 })
    );
    assert!(editor.actions(URI, 0, 0).is_empty());
    let mended = applied(FALL, &actions[0]);
    assert_eq!(mended, FALL.replace("v^2 = g (H - h)", r"v^2 = 2 g \cdot (H - h)"));
    editor.change(URI, 2, &mended);
    assert!(editor.diagnostics(URI, 2).is_empty());
    let hover = editor.hover(URI, 3, start as u64 + 2);
    assert!(
        hover["contents"]["value"].as_str().unwrap().starts_with("(3) proved"),
        "{hover}"
    );
    editor.notify("textDocument/didClose", json!({ "textDocument": { "uri": URI } }));
    let message = editor.next();
    assert_eq!(message["params"], json!({ "uri": URI, "diagnostics": [] }));
    assert_eq!(
        editor.code(
            "textDocument/hover",
            json!({ "textDocument": { "uri": URI }, "position": { "line": 0, "character": 0 } })
        ),
        -32_602
    );
    assert_eq!(editor.result("shutdown", Value::Null), Value::Null);
    assert_eq!(editor.end(true), Some(0));
}

#[test]
fn markdown_sheets_and_what_cannot_be_read_are_marked_too() {
    let mut editor = Editor::ready();
    let notes = "# Notes\n<!-- audit: symbols a, b -->\n$$ (a + b)^2 = a^2 + b^2 + a b $$ <!-- audit: claim -->\n\nMore text.\n";
    editor.open("file:///nowhere/notes.md", "markdown", notes);
    assert_eq!(editor.diagnostics("file:///nowhere/notes.md", 1)[0]["code"], "refuted");
    editor.diagnostics("file:///nowhere/notes.md", 1);
    let actions = editor.actions("file:///nowhere/notes.md", 2, 5);
    editor.change("file:///nowhere/notes.md", 2, &applied(notes, &actions[0]));
    assert!(editor.diagnostics("file:///nowhere/notes.md", 2).is_empty());
    let sheet = "[symbols]\nparameters = ['x']\n[[equation]]\nlabel = 's'\nrole = 'claim'\ntex = 'x + x = 3 x'\n";
    editor.open("file:///nowhere/sheet.toml", "toml", sheet);
    assert_eq!(
        editor.diagnostics("file:///nowhere/sheet.toml", 1)[0]["range"]["start"],
        json!({ "line": 5, "character": 7 })
    );
    editor.diagnostics("file:///nowhere/sheet.toml", 1);
    let actions = editor.actions("file:///nowhere/sheet.toml", 5, 8);
    assert!(applied(sheet, &actions[0]).contains("x + x = 2 x"), "{actions:?}");
    editor.change("file:///nowhere/sheet.toml", 2, &sheet.replace("role", "rol"));
    let found = editor.diagnostics("file:///nowhere/sheet.toml", 2);
    assert!(
        found[0]["message"].as_str().unwrap().contains("did you mean `role`?"),
        "{found:?}"
    );
    editor.change(
        "file:///nowhere/sheet.toml",
        3,
        &sheet.replace("x + x = 3 x", "x + y = 3 x"),
    );
    let found = editor.diagnostics("file:///nowhere/sheet.toml", 3);
    assert_eq!(
        (&found[0]["code"], &found[0]["range"]["start"]["character"]),
        (&json!("unread"), &json!(11))
    );
    // no formulas are here
    for (uri, language, text) in [
        ("file:///nowhere/Cargo.toml", "toml", "[package]\nname = 'a'\n"),
        ("file:///nowhere/empty.tex", "latex", ""),
        ("file:///nowhere/main.rs", "rust", "fn main() {}"),
        ("file:///nowhere/a.ipynb", "json", "{"),
    ] {
        editor.open(uri, language, text);
        assert!(editor.diagnostics(uri, 1).is_empty(), "{uri}");
    }
    editor.open("untitled:Untitled-1", "latex", FALL);
    assert_eq!(editor.diagnostics("untitled:Untitled-1", 1).len(), 1);
    // the input ends without a word
    assert_eq!(editor.end(false), Some(1));
}

#[test]
fn a_document_without_comments_is_marked_where_a_link_is_suspect() {
    let text = "Then\n\\begin{align} (x + y)^2 &= x^2 + x y + y^2 \\\\ &= y^2 + 2 x y + x^2 \\end{align}\n";
    let mut editor = Editor::ready();
    editor.open(URI, "latex", text);
    let found = editor.diagnostics(URI, 1);
    assert_eq!(
        (found.len(), &found[0]["code"], &found[0]["severity"]),
        (1, &json!("suspect"), &json!(2)),
        "{found:?}"
    );
}

#[test]
fn only_the_last_version_is_published() {
    let slow = FALL.replace(
        "v^2 = g (H - h)",
        "(E^7 + v^7 + h^7 + H^7 + m^7 + g^7 + E v h H m g) (m + g) \\ge 6 E v h H m g (h^3 - H^3 + m g - E v)",
    );
    let mut editor = Editor::ready();
    let start = Instant::now();
    editor.open(URI, "latex", &slow);
    let waiting = editor.request(
        "textDocument/hover",
        json!({ "textDocument": { "uri": URI }, "position": { "line": 3, "character": 40 } }),
    );
    for version in 2..40 {
        editor.change(URI, version, &slow.replace("6 E", &format!("{version} E")));
    }
    editor.change(URI, 40, FALL);
    let mut seen = Vec::new();
    loop {
        let message = editor.next();
        if message["id"] == waiting {
            // answered, or refused as the text has changed
            assert!(
                message["error"]["code"] == -32_801 || message["result"].is_object(),
                "{message}"
            );
            continue;
        }
        seen.push(message["params"]["version"].as_i64().expect("a version"));
        if seen.last() == Some(&40) {
            break;
        }
    }
    assert!(seen.is_sorted(), "{seen:?}");
    assert!(start.elapsed() < Duration::from_secs(60));
    let cancelled = editor.request(
        "textDocument/codeAction",
        json!({
            "textDocument": { "uri": URI },
            "range": { "start": { "line": 3, "character": 40 }, "end": { "line": 3, "character": 40 } },
            "context": { "diagnostics": [] },
        }),
    );
    editor.notify("$/cancelRequest", json!({ "id": cancelled }));
    loop {
        let message = editor.next();
        if message["id"] == cancelled {
            assert!(
                message["error"]["code"] == -32_800 || message["result"].is_array(),
                "{message}"
            );
            break;
        }
    }
}

#[test]
fn wrong_messages_have_their_errors_and_end_nothing() {
    let mut editor = Editor::new();
    assert_eq!(editor.code("textDocument/hover", json!({})), -32_002);
    editor.result("initialize", json!({ "capabilities": {} }));
    assert_eq!(editor.code("initialize", json!({})), -32_600);
    for text in [
        "Content-Length: 8\r\n\r\nnonsense",
        "nonsense\r\n\r\n",
        "Content-Length: x\r\n\r\n",
    ] {
        editor.raw(text);
        assert_eq!(editor.next()["error"]["code"], -32_700, "{text}");
    }
    for text in ["3", "[]", r#"{"jsonrpc":"1.0","id":1,"method":"x"}"#] {
        editor.raw(&format!("Content-Length: {}\r\n\r\n{text}", text.len()));
        assert_eq!(editor.next()["error"]["code"], -32_600, "{text}");
    }
    let long = 40 << 20;
    editor.raw(&format!("Content-Length: {long}\r\n\r\n{}", " ".repeat(long)));
    assert_eq!(editor.next()["error"]["code"], -32_600);
    assert_eq!(editor.code("textDocument/rename", json!({})), -32_601);
    assert_eq!(
        editor.code("textDocument/hover", json!({ "textDocument": { "uri": URI } })),
        -32_602
    );
    for params in [
        json!({}),
        json!({ "textDocument": { "uri": URI }, "contentChanges": [] }),
        json!([]),
    ] {
        editor.notify("textDocument/didChange", params.clone());
        editor.notify("textDocument/didOpen", params);
    }
    // a client that takes no versions has plain changes
    editor.open(URI, "latex", FALL);
    let place = json!({ "line": 3, "character": 40 });
    let range = json!({ "start": place, "end": place });
    let params = json!({ "textDocument": { "uri": URI }, "range": range, "context": { "diagnostics": [] } });
    let actions = editor.result("textDocument/codeAction", params);
    assert!(actions[0]["edit"]["changes"][URI].is_array(), "{actions}");
    assert_eq!(editor.result("shutdown", Value::Null), Value::Null);
    assert_eq!(editor.code("textDocument/hover", json!({})), -32_600);
    assert_eq!(editor.end(false), Some(0));
    let editor = Editor::ready();
    assert_eq!(editor.end(true), Some(1));
}

#[test]
fn a_quick_fix_keeps_what_the_formula_does_not_say() {
    // brackets that are sized, labels, alignment and comments
    for (text, line, wanted) in [
        (
            "% audit: symbols x, y\n\\[ \\left( x+y \\right)^{2} = x^{2} + 3 x y + {y}^{2} \\] % audit: claim\n",
            1,
            "% audit: symbols x, y\n\\[ \\left( x+y \\right)^{2} = x^2 + 2 x y + y^2 \\] % audit: claim\n",
        ),
        (
            "% audit: symbols x, y\n\\begin{align} (x+y)^2 \\label{a} % audit: claim\n  &= x^2 + 3xy + y^2 \\tag{A} % todo\n\\end{align}\n",
            1,
            "% audit: symbols x, y\n\\begin{align} (x+y)^2 \\label{a} % audit: claim\n  &= x^2 + 2 x y + y^2 \\tag{A} % todo\n\\end{align}\n",
        ),
    ] {
        let mut editor = Editor::ready();
        editor.open(URI, "latex", text);
        editor.diagnostics(URI, 1);
        let actions = editor.actions(URI, line, 20);
        assert_eq!(applied(text, &actions[0]), wanted, "{actions:?}");
    }
}

#[test]
fn a_file_that_is_saved_is_read_anew_where_others_include_it() {
    let scratch = scratch("lsp_included");
    let included = scratch.file("macros.tex", "\\newcommand{\\double}{2 x}\n");
    let uri = format!("file://{}", included.replace("macros.tex", "main.tex"));
    let text = "% audit: symbols x\n\\input{macros}\n\\[ x + x = \\double \\] % audit: claim\n";
    let mut editor = Editor::ready();
    editor.open(&uri, "latex", text);
    assert_eq!(editor.diagnostics(&uri, 1), Vec::<Value>::new());
    scratch.file("macros.tex", "\\newcommand{\\double}{9 x}\n");
    editor.notify("textDocument/didSave", json!({ "textDocument": { "uri": uri } }));
    let found = loop {
        let found = editor.diagnostics(&uri, 1);
        if !found.is_empty() {
            break found;
        }
    };
    assert_eq!(found[0]["code"], "refuted", "{found:?}");
}
