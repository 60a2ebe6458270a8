//! So much of something, shared between clients: each of them may hold only a part of it.

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// How much there is of something, in all and for one client, and who holds it; copies are the same.
#[derive(Debug, Clone)]
pub struct Quota(Arc<Books>);

#[derive(Debug)]
struct Books {
    most: usize,
    most_each: usize,
    held: Mutex<Held>,
}

#[derive(Debug, Default)]
struct Held {
    all: usize,
    each: BTreeMap<String, usize>,
}

/// What one client holds, until it is dropped.
#[derive(Debug)]
pub struct Share {
    quota: Quota,
    client: String,
    amount: usize,
}

/// Why there is no share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Full {
    /// The client holds as much as one may.
    OfClient,
    /// All clients together hold all there is.
    OfAll,
}

impl Quota {
    /// So much in all, and so much of it for one client.
    pub fn new(most: usize, most_each: usize) -> Self {
        Quota(Arc::new(Books { most, most_each: most_each.min(most), held: Mutex::default() }))
    }

    /// What one client may hold.
    pub fn most_each(&self) -> usize {
        self.0.most_each
    }

    /// What all hold together.
    pub fn amount(&self) -> usize {
        self.held().all
    }

    /// A share of this size.
    ///
    /// # Errors
    /// When it is more than is left, of the client's part or of all.
    pub fn take(&self, client: &str, amount: usize) -> Result<Share, Full> {
        let mut share = Share { quota: self.clone(), client: client.to_owned(), amount: 0 };
        share.grow(amount).map(|()| share)
    }

    fn held(&self) -> MutexGuard<'_, Held> {
        // Sums are written when they are right, whatever happens to their holder.
        self.0.held.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Share {
    /// Takes so much more.
    ///
    /// # Errors
    /// When it is more than is left; the share stays as it was.
    pub fn grow(&mut self, more: usize) -> Result<(), Full> {
        let Books { most, most_each, .. } = *self.quota.0;
        let mut held = self.quota.held();
        let of_client = held.each.get(&self.client).copied().unwrap_or(0).saturating_add(more);
        let of_all = held.all.saturating_add(more);
        if of_client > most_each {
            return Err(Full::OfClient);
        }
        if of_all > most {
            return Err(Full::OfAll);
        }
        held.all = of_all;
        held.each.insert(self.client.clone(), of_client);
        drop(held);
        self.amount += more;
        Ok(())
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        let mut held = self.quota.held();
        held.all -= self.amount;
        let left = held.each.get(&self.client).map_or(0, |of_client| of_client - self.amount);
        match left {
            0 => drop(held.each.remove(&self.client)),
            _ => drop(held.each.insert(self.client.clone(), left)),
        }
    }
}

/// How a client without a token is named: by its address. Whoever has one IPv6 address has 2^64 of them.
pub fn address_name(address: IpAddr) -> String {
    match address.to_canonical() {
        IpAddr::V4(address) => address.to_string(),
        IpAddr::V6(address) => {
            let [a, b, c, d, ..] = address.segments();
            format!("{a:x}:{b:x}:{c:x}:{d:x}::/64")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_client_has_its_part_and_all_have_all() {
        let quota = Quota::new(10, 6);
        let mut first = quota.take("a", 4).unwrap();
        assert_eq!(quota.take("a", 3).err(), Some(Full::OfClient));
        assert_eq!((first.grow(3), first.grow(2)), (Err(Full::OfClient), Ok(())));
        assert_eq!(quota.take("b", 5).err(), Some(Full::OfAll));
        let second = quota.take("b", 4).unwrap();
        assert_eq!(quota.take("c", 1).err(), Some(Full::OfAll));
        drop(first);
        assert_eq!(quota.held().each.len(), 1);
        assert!(quota.take("c", 6).is_ok());
        drop(second);
        let held = quota.held();
        assert_eq!((held.all, held.each.len()), (0, 0));
    }

    #[test]
    fn addresses_of_one_network_are_one_client() {
        let name = |address: &str| address_name(address.parse().unwrap());
        assert_eq!(name("::ffff:192.0.2.1"), name("192.0.2.1"));
        assert_eq!(name("2001:db8:1:2::1"), name("2001:db8:1:2:ffff::7"));
        assert_ne!(name("2001:db8:1:2::1"), name("2001:db8:1:3::1"));
        assert_ne!(name("192.0.2.1"), name("192.0.2.2"));
    }
}
