//! Tokens, and what each may do.

use sha2::{Digest, Sha256};
use std::sync::{Arc, PoisonError, RwLock};
use subtle::ConstantTimeEq;

/// What a token may do; a word of each in a file of tokens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::http) enum Role {
    /// Submit jobs and look requests over; cancel and forget its own.
    Submit,
    /// See its own jobs and their results.
    Read,
    /// See the jobs of all.
    ReadAll,
    /// See what the service counts.
    Metrics,
    /// All of this, and cancel and forget the jobs of all.
    Admin,
}

/// Every role, with its word.
const ROLES: [(&str, Role); 5] = [
    ("submit", Role::Submit),
    ("read", Role::Read),
    ("read-all", Role::ReadAll),
    ("metrics", Role::Metrics),
    ("admin", Role::Admin),
];

/// What a token of the command line may do.
const PLAIN: [Role; 3] = [Role::Submit, Role::Read, Role::Metrics];

impl Role {
    /// Its word.
    pub(in crate::http) fn word(self) -> &'static str {
        ROLES.iter().find(|(_, role)| *role == self).map_or("", |(word, _)| word)
    }
}

/// A token, kept as its digest.
#[derive(Debug)]
pub(super) struct Token {
    /// Whose it is: jobs and keys belong to this name.
    pub(super) name: Arc<str>,
    digest: [u8; 32],
    roles: Arc<[Role]>,
}

/// A client with its roles.
#[derive(Debug, Clone)]
pub(super) struct Holder {
    pub(super) name: Arc<str>,
    pub(super) roles: Arc<[Role]>,
    /// Of its token.
    pub(super) digest: [u8; 32],
}

/// The bearer tokens that open the service; with none of them it is open to all. Copies change together.
#[derive(Debug, Clone, Default)]
pub struct Tokens(Arc<RwLock<Vec<Token>>>);

impl Tokens {
    /// Tokens that may submit, read their own jobs, and see what is counted. Each is a client of its own, named after the digest of
    /// the token, and so the same wherever and whenever it is used.
    pub fn new<'a>(tokens: impl IntoIterator<Item = &'a str>) -> Self {
        let token = |token| {
            let digest: [u8; 32] = Sha256::digest(token).into();
            let name = digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect::<String>();
            Token { name: format!("token {name}").into(), digest, roles: PLAIN.into() }
        };
        Tokens(Arc::new(RwLock::new(tokens.into_iter().map(token).collect())))
    }

    /// Takes the tokens of a file instead of those known so far. A line has a name, roles with commas between them, and a token;
    /// `#` begins a comment.
    ///
    /// # Errors
    /// What is wrong with which line; nothing is changed then. The text does not repeat tokens.
    pub fn replace(&self, text: &str) -> Result<usize, String> {
        let lines = text.lines().enumerate().map(|(number, line)| (number + 1, line.trim()));
        let lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let tokens: Vec<_> = lines
            .map(|(number, line)| parse(line).map_err(|fault| format!("line {number}: {fault}")))
            .collect::<Result<_, _>>()?;
        if tokens.is_empty() {
            return Err("there is no token, and without one the service would be open to all".to_owned());
        }
        let count = tokens.len();
        *self.0.write().unwrap_or_else(PoisonError::into_inner) = tokens;
        Ok(count)
    }

    /// True where the service is open to all.
    pub fn is_open(&self) -> bool {
        self.0.read().unwrap_or_else(PoisonError::into_inner).is_empty()
    }

    /// Whose token this is. Takes the same time for every token, known or not.
    pub(super) fn holder(&self, token: &str) -> Option<Holder> {
        let asked: [u8; 32] = Sha256::digest(token).into();
        self.holder_where(|digest| digest.ct_eq(&asked).into())
    }

    /// Whose token has a digest of which this is true; all are asked.
    pub(super) fn holder_where(&self, is: impl Fn(&[u8; 32]) -> bool) -> Option<Holder> {
        let tokens = self.0.read().unwrap_or_else(PoisonError::into_inner);
        let found = tokens.iter().fold(None, |found, one| if is(&one.digest) { Some(one) } else { found });
        found.map(|token| Holder { name: token.name.clone(), roles: token.roles.clone(), digest: token.digest })
    }
}

/// Reads a line of a file of tokens.
fn parse(line: &str) -> Result<Token, String> {
    let parts: Vec<_> = line.split_whitespace().collect();
    let [name, roles, token] = parts[..] else {
        return Err("write a name, roles with commas between them, and a token".to_owned());
    };
    let role = |word: &str| {
        let words = || ROLES.map(|(word, _)| word).join(", ");
        let found = ROLES.iter().find(|(known, _)| *known == word);
        found.map(|(_, role)| *role).ok_or_else(|| format!("{word} is no role; these are: {}", words()))
    };
    if !is_token(token) {
        return Err(NO_TOKEN.to_owned());
    }
    let roles = roles.split(',').map(role).collect::<Result<Arc<[_]>, _>>()?;
    Ok(Token { name: name.into(), digest: Sha256::digest(token).into(), roles })
}

/// What is said where a token cannot be one.
pub const NO_TOKEN: &str = "a token is made of letters, digits and -._~+/= and is not empty";

/// True for what an authorization header can carry (`b64token` of RFC 6750).
pub fn is_token(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-._~+/=".contains(&byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_tokens_is_taken_whole_or_not_at_all() {
        let tokens = Tokens::default();
        assert!(tokens.is_open());
        let file = "# name  roles  token\n\nassessor submit,read s3cret\n  probe\tmetrics\tabc= \n";
        assert_eq!(tokens.replace(file), Ok(2));
        let holder = tokens.holder("s3cret").unwrap();
        assert_eq!((&*holder.name, &*holder.roles), ("assessor", &[Role::Submit, Role::Read][..]));
        assert!(tokens.holder("s3cre").is_none() && tokens.holder("").is_none());
        for (bad, place) in [
            ("", "no token"),
            ("# nothing", "no token"),
            ("a submit", "line 1: write a name"),
            ("a submit x\nb reader y", "line 2: reader is no role; these are: submit, read, read-all, metrics, admin"),
            ("a submit ö", "line 1: a token is made of"),
            ("a submit, x", "line 1:  is no role"),
        ] {
            let fault = tokens.replace(bad).unwrap_err();
            assert!(fault.contains(place), "{fault}");
            assert_eq!(&*tokens.holder("abc=").unwrap().name, "probe", "those known so far stay");
        }
    }
}
