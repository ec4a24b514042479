//! `mcp`, by a client that is written from the specification of the Model Context Protocol.

use crate::common::program::{Scratch, program, scratch};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// The time in which any answer comes, on a machine that is busy too.
const LONGEST: Duration = Duration::from_secs(120);

/// A client with a server of its own.
struct Client {
    server: Child,
    stdin: Option<ChildStdin>,
    lines: Receiver<Value>,
    last: u64,
}

impl Client {
    /// A client of a server in this directory, before the handshake.
    fn new(directory: &Scratch) -> Self {
        let mut command = program(["mcp"]).within(&**directory).command();
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        let mut server = command.spawn().expect("the program");
        let (stdin, stdout) = (server.stdin.take(), server.stdout.take().expect("its output"));
        let (send, lines) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(stdout).lines().map_while(Result::ok) {
                let message = serde_json::from_str(&line).unwrap_or_else(|error| panic!("{error}: {line}"));
                if send.send(message).is_err() {
                    break;
                }
            }
        });
        Self {
            server,
            stdin,
            lines,
            last: 0,
        }
    }

    /// A client behind the handshake.
    fn ready(directory: &Scratch) -> Self {
        let mut client = Self::new(directory);
        let result = client.result("initialize", hello("2025-06-18"));
        assert_eq!(result["protocolVersion"], "2025-06-18");
        client.notify("notifications/initialized", json!({}));
        client
    }

    fn raw(&mut self, bytes: &[u8]) {
        let stdin = self.stdin.as_mut().expect("an input");
        stdin.write_all(bytes).expect("it is read");
        stdin.flush().expect("it is read");
    }

    fn send(&mut self, message: &Value) {
        self.raw(format!("{message}\n").as_bytes());
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Sends a request, and returns its id.
    fn request(&mut self, method: &str, params: Value) -> u64 {
        self.last += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.last, "method": method, "params": params }));
        self.last
    }

    fn next(&mut self) -> Value {
        let message = self.lines.recv_timeout(LONGEST).expect("a message");
        let is_whole = message.is_array() || message["jsonrpc"] == "2.0";
        assert!(is_whole, "{message}");
        message
    }

    /// Sends a request, and returns its response, which is the next message.
    fn response(&mut self, method: &str, params: Value) -> Value {
        let id = self.request(method, params);
        let response = self.next();
        assert_eq!(response["id"], id, "{response}");
        response
    }

    #[track_caller]
    fn result(&mut self, method: &str, params: Value) -> Value {
        let response = self.response(method, params);
        assert!(response.get("error").is_none(), "{response}");
        response["result"].clone()
    }

    #[track_caller]
    fn error(&mut self, method: &str, params: Value) -> (i64, String) {
        let error = self.response(method, params)["error"].clone();
        let message = error["message"].as_str().expect("a message").to_owned();
        (error["code"].as_i64().expect("a code"), message)
    }

    /// Calls a tool; its result is held against its schema.
    #[track_caller]
    fn call(&mut self, name: &str, arguments: Value) -> Value {
        let result = self.result("tools/call", json!({ "name": name, "arguments": arguments }));
        assert!(result["content"][0]["text"].is_string(), "{result}");
        result
    }

    /// Ends the input, and returns the exit status and the messages that are left.
    fn end(mut self) -> (Option<i32>, Vec<Value>) {
        drop(self.stdin.take());
        let left = self.lines.iter().collect();
        (self.server.wait().expect("an end").code(), left)
    }
}

fn hello(version: &str) -> Value {
    let client = json!({ "name": "test", "version": "1" });
    json!({ "protocolVersion": version, "capabilities": {}, "clientInfo": client })
}

/// Returns the first mismatch of a value by the part of JSON Schema that the tools use.
fn mismatch(value: &Value, schema: &Value, path: &str) -> Option<String> {
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        _ => return None,
    };
    let is_one = |kind: &&str| match *kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_i64() || value.is_u64(),
        "null" => value.is_null(),
        kind => panic!("an unknown type {kind}"),
    };
    if !kinds.iter().any(is_one) {
        return Some(format!("{path} should be {kinds:?}: {value}"));
    }
    let required = schema["required"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_str);
    for name in required {
        if value.get(name).is_none() {
            return Some(format!("{path}.{name} is missing"));
        }
    }
    let properties = schema["properties"].as_object().into_iter().flatten();
    let own = properties.filter_map(|(name, schema)| mismatch(value.get(name)?, schema, &format!("{path}.{name}")));
    let items = value.as_array().into_iter().flatten();
    let items = items.filter_map(|item| mismatch(item, &schema["items"], &format!("{path}[]")));
    own.chain(items).next()
}

const FALL: &str = r"% audit: symbols E, v, h, H; positive m, g
\begin{equation} E = \frac{1}{2} m v^2 + m g h \label{energy} \end{equation}  % audit: premise
\begin{equation} E = m g H \label{rest} \end{equation}                        % audit: premise
\begin{equation} v^2 = g (H - h) \end{equation}  % audit: claim; follows from \eqref{energy}, \eqref{rest}
";

/// A scene whose motions take far longer to find than a test waits.
const LONG: &str = "words = ['BBBTTT', 'BBTBTT', 'BBTTBT', 'BTTTTT', 'BBBBBT']
max_periods = 64
[motion]
g = 0.122
d = 0.4
r_b = 0.5
r_t = 0.5
";

#[test]
fn versions_are_negotiated_and_what_the_server_has_is_listed() {
    let scratch = scratch("handshake");
    for (asked, given) in [
        ("2025-06-18", "2025-06-18"),
        ("2025-03-26", "2025-03-26"),
        ("2024-11-05", "2024-11-05"),
        ("1999-01-01", "2025-06-18"),
    ] {
        let mut client = Client::new(&scratch);
        let result = client.result("initialize", hello(asked));
        assert_eq!(result["protocolVersion"], given);
        assert_eq!(result["serverInfo"]["name"], "vibro-audit");
        assert!(result["instructions"].as_str().unwrap().contains("% audit:"));
        assert!(result["capabilities"]["tools"].is_object());
        assert_eq!(client.end(), (Some(0), Vec::new()));
    }
    let mut client = Client::ready(&scratch);
    assert_eq!(client.result("ping", json!({})), json!({}));
    let tools = client.result("tools/list", json!({}))["tools"].clone();
    let names: Vec<&str> = tools
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|tool| tool["name"].as_str())
        .collect();
    assert_eq!(names, ["audit", "explain", "repair", "check", "orbits"]);
    for tool in tools.as_array().unwrap() {
        assert_eq!(tool["annotations"]["readOnlyHint"], true);
        assert_eq!(tool["inputSchema"]["type"], "object");
        assert!(tool["description"].as_str().unwrap().len() > 40);
    }
    let resources = client.result("resources/list", json!({}))["resources"].clone();
    for resource in resources.as_array().unwrap() {
        let read = client.result("resources/read", json!({ "uri": resource["uri"] }));
        assert!(read["contents"][0]["text"].as_str().unwrap().starts_with("# "));
    }
    assert_eq!(
        client.error("resources/read", json!({ "uri": "file:///etc/passwd" })).0,
        -32_002
    );
    assert_eq!(client.end(), (Some(0), Vec::new()));
}

#[test]
fn the_results_of_all_tools_are_as_their_schemas_say() {
    let scratch = scratch("schemas");
    scratch.file("fall.tex", FALL);
    let mut client = Client::ready(&scratch);
    let tools = client.result("tools/list", json!({}))["tools"].clone();
    let scene = "[motion]\ng = 0.122\nd = 0.4\nr_b = 0.5\nr_t = 0.5\n";
    let printed = "id,place,scene,set,quantity,printed,unit,expected,rests_on,note\n\
                   t,Table 1,fig02,motion.d=0.4,orbits.velocities[0],0.83272,,reproduced,,\n";
    std::fs::create_dir(scratch.join("mine")).unwrap();
    scratch.file("mine/printed.csv", printed);
    for (name, arguments, words) in [
        (
            "audit",
            json!({ "path": "fall.tex" }),
            "1 claim: 1 refuted; not all as expected",
        ),
        (
            "audit",
            json!({ "text": FALL, "name": "a.tex", "repair": true, "findings_only": true, "effort": 2 }),
            "refuted",
        ),
        ("explain", json!({ "path": "fall.tex", "label": "(3)" }), "right = 9/2"),
        (
            "repair",
            json!({ "path": "fall.tex", "label": "3" }),
            "replace `g (H - h)` by",
        ),
        ("check", json!({ "directory": "mine" }), "reproduced"),
        ("orbits", json!({ "text": scene }), "complete: true"),
        (
            "orbits",
            json!({ "scene": "fig02", "set": ["motion.d=0.3"], "digits": 20 }),
            "BT",
        ),
    ] {
        let result = client.call(name, arguments);
        let text = result["content"][0]["text"].as_str().unwrap();
        assert_eq!(result["isError"], false, "{text}");
        assert!(text.contains(words), "{name}: {text}");
        let tool = tools
            .as_array()
            .unwrap()
            .iter()
            .find(|tool| tool["name"] == name)
            .unwrap();
        if let Some(schema) = tool.get("outputSchema") {
            assert_eq!(mismatch(&result["structuredContent"], schema, name), None);
        }
    }
    // the rows are those of the command
    let rows = client.call("audit", json!({ "path": "fall.tex" }))["structuredContent"]["formulas"].clone();
    let ran = scratch.run(&["audit", "fall.tex", "--format", "json"]);
    assert_eq!(rows, serde_json::from_str::<Value>(&ran.stdout).unwrap());
}

#[test]
fn an_assistant_finds_an_error_repairs_it_and_audits_again() {
    let scratch = scratch("scenario");
    let mut client = Client::ready(&scratch);
    // a draft without comments: nothing is refuted
    let bare: String = FALL
        .lines()
        .map(|line| format!("{}\n", line.split('%').next().unwrap_or_default()))
        .collect();
    let found = client.call("audit", json!({ "text": bare, "name": "fall.tex" }));
    assert_ne!(found["structuredContent"]["formulas"][2]["verdict"], "refuted");
    // with the comments that the instructions teach, it is
    let found = client.call("audit", json!({ "text": FALL, "name": "fall.tex" }));
    let row = &found["structuredContent"]["formulas"][0];
    assert_eq!((&row["label"], &row["verdict"]), (&"3".into(), &"refuted".into()));
    let found = client.call("repair", json!({ "text": FALL, "name": "fall.tex" }));
    let edit = &found["structuredContent"]["formulas"][0]["repairs"][0]["edits"][0];
    let line = FALL.lines().nth(3).unwrap();
    let place = |end: &str| edit[end]["column"].as_u64().unwrap() as usize - 1;
    assert_eq!(edit["start"]["line"], 4);
    assert_eq!(line[place("start")..place("end")], *edit["old"].as_str().unwrap());
    let mended = FALL.replace(edit["old"].as_str().unwrap(), edit["new"].as_str().unwrap());
    let found = client.call("audit", json!({ "text": mended, "name": "fall.tex" }));
    assert_eq!(found["structuredContent"]["formulas"][0]["verdict"], "proved");
    assert_eq!(found["structuredContent"]["as_expected"], true);
    // the guide shows this session
    let page = include_str!("../../doc/reference/editors.md");
    let own = page.split("```tex\n").nth(1).and_then(|rest| rest.split("```").next());
    let own = own.expect("a document");
    let mended = own.replace("v^2 = g (H - h)", r"v^2 = 2 g \cdot (H - h)");
    let shown: Vec<&str> = page.lines().filter(|line| line.starts_with("assistant ")).collect();
    assert_eq!(shown.len(), 3);
    for (line, text) in shown.into_iter().zip([own, own, &mended]) {
        let parts: Vec<&str> = line.split("  ").filter(|part| !part.is_empty()).collect();
        let (tool, result) = (parts[1].trim(), parts.last().expect("a result"));
        let found = client.call(tool, json!({ "text": text, "name": "fall.tex" }));
        let said = found["content"][0]["text"].as_str().unwrap();
        for part in result.split("; ") {
            assert!(said.contains(part.trim()), "`{part}` is not in {said}");
        }
    }
    let none = client.call("repair", json!({ "text": mended, "name": "fall.tex" }));
    assert!(
        none["content"][0]["text"]
            .as_str()
            .unwrap()
            .contains("nothing to repair")
    );
}

#[test]
fn the_examples_of_the_instructions_are_proved() {
    let scratch = scratch("instructions");
    let mut client = Client::new(&scratch);
    let result = client.result("initialize", hello("2025-06-18"));
    let instructions = result["instructions"].as_str().unwrap();
    let example = |name: &str| -> String {
        let start = instructions.find(&format!("{name}:\n")).expect("an example") + name.len() + 2;
        let lines = instructions[start..].lines().take_while(|line| line.starts_with("  "));
        lines.map(|line| format!("{}\n", &line[2..])).collect()
    };
    for name in ["fall.tex", "fall.toml"] {
        let found = client.call("audit", json!({ "text": example(name), "name": name }));
        assert_eq!(found["structuredContent"]["counts"], json!({ "proved": 1 }), "{found}");
    }
    // each line of the grammar is understood
    let document = r"% audit: symbols a, b, c, r; positive m, g; functions F' = f
% audit: symbols states z; indices n
% audit: default claim
\begin{equation} a = b c \label{fall} \end{equation} % audit: premise
\begin{equation} a = 2 r b \tag{9} \end{equation} % audit: definition
\begin{equation} a^2 = b^2 c^2 \end{equation} % audit: follows from \eqref{fall}; label square
\begin{equation} a^3 = b^2 c^2 \end{equation} % audit: follows from \eqref{fall}; expect refuted
\begin{equation} \sqrt{c^2} = c \end{equation} % audit: assume c > 0
\begin{equation} \Delta + 4 a c = b^2 \end{equation} % audit: where \Delta = b^2 - 4 a c
\begin{equation} a + x^2 y \end{equation} % audit: skip
";
    let found = client.call("audit", json!({ "text": document, "name": "grammar.tex" }));
    assert_eq!(found["structuredContent"]["as_expected"], true, "{found}");
    assert_eq!(
        found["structuredContent"]["counts"],
        json!({ "proved": 3, "refuted": 1 }),
        "{found}"
    );
}

#[test]
fn unusable_input_is_a_result_that_says_what_to_do() {
    let scratch = scratch("unusable");
    let mut client = Client::ready(&scratch);
    let long = "% x\n".repeat(3 << 20);
    for (name, arguments, words) in [
        ("audit", json!({ "path": "none.tex" }), "there is no such file"),
        ("audit", json!({ "path": "-" }), "there is no such file"),
        ("audit", json!({ "text": "[[equation]\n", "name": "a.toml" }), "line 1"),
        ("audit", json!({ "text": long, "name": "a.tex" }), "more than 8 MB"),
        (
            "explain",
            json!({ "text": FALL, "name": "a.tex", "label": "7" }),
            "no claim `7` (there are: 3)",
        ),
        (
            "repair",
            json!({ "text": FALL, "name": "a.tex", "label": "7" }),
            "no claim `7` (there are: 3)",
        ),
        ("check", json!({ "directory": "none" }), "none"),
        ("orbits", json!({ "scene": "fig99" }), "did you mean"),
        ("orbits", json!({ "scene": "-" }), "there is no such file"),
        ("orbits", json!({ "text": "d = 1" }), "d"),
        ("orbits", json!({ "scene": "fig02", "digits": 1_000_000 }), "10000"),
        ("audit", json!({ "text": FALL, "effort": 100_000_000 }), "1000000"),
    ] {
        let result = client.call(name, arguments);
        let text = result["content"][0]["text"].as_str().unwrap();
        assert!(result["isError"] == true && text.contains(words), "{name}: {text}");
        assert!(result.get("structuredContent").is_none());
    }
}

#[test]
fn wrong_messages_have_their_errors_and_end_nothing() {
    let scratch = scratch("malformed");
    let mut client = Client::ready(&scratch);
    for (line, code) in [
        (&b"nonsense\n"[..], -32_700),
        (b"{\"jsonrpc\":\"2.0\",\n", -32_700),
        (b"\xff\xfe\n", -32_700),
        (b"3\n", -32_600),
        (b"[]\n", -32_600),
        (b"{\"id\":1,\"method\":\"ping\"}\n", -32_600),
    ] {
        client.raw(line);
        let response = client.next();
        assert_eq!(response["error"]["code"], code, "{response}");
    }
    client.raw(format!("{}\n", "[".repeat(100_000)).as_bytes());
    assert_eq!(client.next()["error"]["code"], -32_700);
    client.raw(b"\n  \n");
    assert_eq!(client.error("tools/explode", json!({})).0, -32_601);
    for (params, words) in [
        (json!({ "name": "shell", "arguments": {} }), "there is no tool `shell`"),
        (json!({ "arguments": {} }), "`name`"),
        (json!({ "name": "audit" }), "give `text` or `path`"),
        (
            json!({ "name": "audit", "arguments": [] }),
            "`arguments` should be an object",
        ),
        (
            json!({ "name": "audit", "arguments": { "text": "", "path": "" } }),
            "not both",
        ),
        (
            json!({ "name": "audit", "arguments": { "text": 3 } }),
            "`text` should be a string",
        ),
        (
            json!({ "name": "audit", "arguments": { "txt": "" } }),
            "did you mean `text`?",
        ),
        (
            json!({ "name": "audit", "arguments": { "text": "", "effort": 0 } }),
            "`effort`",
        ),
        (
            json!({ "name": "audit", "arguments": { "text": "", "repair": "yes" } }),
            "`repair`",
        ),
        (
            json!({ "name": "explain", "arguments": { "text": "" } }),
            "`label` is missing",
        ),
        (
            json!({ "name": "orbits", "arguments": { "scene": "fig02", "set": [1] } }),
            "`set`",
        ),
    ] {
        let (code, message) = client.error("tools/call", params);
        assert!(code == -32_602 && message.contains(words), "{code}: {message}");
    }
    assert_eq!(client.error("initialize", json!({})).0, -32_602);
    assert_eq!(client.result("ping", json!({})), json!({}));
}

#[test]
fn a_huge_line_is_refused_and_the_next_one_is_read() {
    let scratch = scratch("huge");
    let mut client = Client::ready(&scratch);
    let block = vec![b'a'; 1 << 20];
    for _ in 0..40 {
        client.raw(&block);
    }
    client.raw(b"\n");
    let response = client.next();
    assert_eq!(
        (&response["id"], &response["error"]["code"]),
        (&Value::Null, &json!(-32_600))
    );
    assert_eq!(client.result("ping", json!({})), json!({}));
}

#[test]
fn a_call_is_cancelled_while_the_server_goes_on_answering() {
    let scratch = scratch("cancel");
    let mut client = Client::ready(&scratch);
    let arguments = json!({ "text": LONG });
    let long = client.request("tools/call", json!({ "name": "orbits", "arguments": arguments }));
    assert_eq!(client.result("ping", json!({})), json!({}));
    // one behind it that never begins
    let waiting = client.request(
        "tools/call",
        json!({ "name": "orbits", "arguments": { "scene": "fig02" } }),
    );
    std::thread::sleep(Duration::from_millis(500));
    let start = Instant::now();
    for id in [waiting, long, 999] {
        client.notify(
            "notifications/cancelled",
            json!({ "requestId": id, "reason": "the text has changed" }),
        );
    }
    // the next message answers the next call: there is none for those that were cancelled
    let found = client.call("audit", json!({ "text": FALL, "name": "fall.tex" }));
    assert_eq!(found["structuredContent"]["counts"]["refuted"], 1);
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
    assert_eq!(client.end(), (Some(0), Vec::new()));
}

#[test]
fn progress_is_reported_where_a_token_asks_for_it() {
    let scratch = scratch("progress");
    let mut client = Client::ready(&scratch);
    let sheet = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/paper/equations.toml");
    let params = json!({
        "name": "audit",
        "arguments": { "path": sheet, "repair": true },
        "_meta": { "progressToken": "mine" },
    });
    let id = client.request("tools/call", params);
    let mut last = 0;
    let response = loop {
        let message = client.next();
        if message.get("id").is_some() {
            break message;
        }
        assert_eq!(message["method"], "notifications/progress");
        assert_eq!(message["params"]["progressToken"], "mine");
        let (now, total) = (&message["params"]["progress"], &message["params"]["total"]);
        assert!(now.as_u64() > Some(last) && now.as_u64() <= total.as_u64(), "{message}");
        last = now.as_u64().unwrap();
    };
    assert_eq!(response["id"], id);
    assert!(last > 0, "no progress of a long call");
    assert_eq!(client.end(), (Some(0), Vec::new()));
}

#[test]
fn calls_that_stand_in_the_input_are_answered_before_the_end() {
    let scratch = scratch("end");
    let mut client = Client::ready(&scratch);
    let ids: Vec<u64> = (0..3)
        .map(|_| {
            client.request(
                "tools/call",
                json!({ "name": "audit", "arguments": { "text": FALL, "name": "a.tex" } }),
            )
        })
        .collect();
    let (status, left) = client.end();
    let answered: Vec<u64> = left.iter().filter_map(|message| message["id"].as_u64()).collect();
    assert_eq!((status, answered), (Some(0), ids));
}

#[test]
fn batches_belong_to_one_version_alone() {
    let scratch = scratch("batches");
    let batch = json!([
        { "jsonrpc": "2.0", "id": "a", "method": "ping" },
        { "jsonrpc": "2.0", "method": "notifications/initialized" },
        { "jsonrpc": "2.0", "id": "b", "method": "tools/call",
          "params": { "name": "audit", "arguments": { "text": FALL, "name": "a.tex" } } },
        7,
    ]);
    let mut client = Client::ready(&scratch);
    client.send(&batch);
    assert_eq!(client.next()["error"]["code"], -32_600);
    let mut client = Client::new(&scratch);
    client.result("initialize", hello("2025-03-26"));
    client.send(&batch);
    let responses = client.next();
    let ids: Vec<&Value> = responses
        .as_array()
        .unwrap()
        .iter()
        .map(|response| &response["id"])
        .collect();
    assert_eq!(ids, [&json!("a"), &Value::Null, &json!("b")]);
}
