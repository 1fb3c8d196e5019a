//! Members sorted into buckets, in one block of memory.

/// A list of members for each bucket, in the order in which they came (a counting sort).
#[derive(Clone, Debug, PartialEq)]
pub struct Buckets<T = u32> {
    /// Where each bucket's list begins in `members`; one more than there are buckets.
    starts: Vec<u32>,
    members: Vec<T>,
}

impl<T: Copy> Buckets<T> {
    /// Sorts pairs of a bucket, below `count`, and a member of it.
    #[inline]
    pub fn new(count: usize, pairs: impl Iterator<Item = (usize, T)> + Clone) -> Self {
        let mut starts = vec![0_u32; count + 1];
        let mut any = None;
        for (bucket, member) in pairs.clone() {
            starts[bucket + 1] += 1;
            any = Some(member);
        }
        for bucket in 0..count {
            starts[bucket + 1] += starts[bucket];
        }
        let mut members = any.map_or(Vec::new(), |any| vec![any; starts[count] as usize]);
        let mut free = starts.clone();
        for (bucket, member) in pairs {
            let place = &mut free[bucket];
            members[*place as usize] = member;
            *place += 1;
        }
        Self { starts, members }
    }

    /// Number of buckets.
    #[inline]
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The members of a bucket.
    #[inline]
    pub fn list(&self, bucket: usize) -> &[T] {
        self.lists_of(bucket, bucket)
    }

    /// The members of a bucket and of all up to another.
    #[inline]
    pub(crate) fn lists_of(&self, first: usize, last: usize) -> &[T] {
        &self.members[self.starts[first] as usize..self.starts[last + 1] as usize]
    }

    /// The members of each bucket in turn.
    #[inline]
    pub fn lists(&self) -> impl Iterator<Item = &[T]> {
        (0..self.count()).map(|bucket| self.list(bucket))
    }

    /// Buckets of what `of` makes of each bucket's number and each of its members.
    #[inline]
    pub fn map<U>(&self, mut of: impl FnMut(usize, T) -> U) -> Buckets<U> {
        let mut members = Vec::with_capacity(self.members.len());
        for (bucket, list) in self.lists().enumerate() {
            members.extend(list.iter().map(|&member| of(bucket, member)));
        }
        let starts = self.starts.clone();
        Buckets { starts, members }
    }

    /// All members, bucket by bucket.
    #[inline]
    pub fn into_members(self) -> Vec<T> {
        self.members
    }

    /// Sorts the members within each bucket.
    #[inline]
    pub fn sort_each(&mut self, mut sort: impl FnMut(&mut [T])) {
        for pair in self.starts.windows(2) {
            sort(&mut self.members[pair[0] as usize..pair[1] as usize]);
        }
    }
}

impl<T> Default for Buckets<T> {
    /// No bucket.
    fn default() -> Self {
        Self {
            starts: vec![0],
            members: Vec::new(),
        }
    }
}

impl Buckets {
    /// The numbers of the edges, or faces, at each of `count` nodes, ascending; `edges` gives the nodes of
    /// each.
    #[inline]
    pub fn around<const N: usize>(
        count: usize,
        edges: impl Iterator<Item = [u32; N]> + Clone,
    ) -> Self {
        let ends = (0..)
            .zip(edges)
            .flat_map(|(edge, ends)| ends.map(|end| (end as usize, edge)));
        Self::new(count, ends)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_keep_their_order_within_their_bucket() {
        let pairs = [(2, 'a'), (0, 'b'), (2, 'c'), (3, 'd'), (2, 'e')];
        let buckets = Buckets::new(5, pairs.into_iter());
        let lists: Vec<String> = buckets.lists().map(|list| list.iter().collect()).collect();
        assert_eq!(lists, ["b", "", "ace", "d", ""]);
        assert_eq!(buckets.lists_of(1, 2), ['a', 'c', 'e']);
        assert_eq!(buckets.into_members(), ['b', 'a', 'c', 'e', 'd']);
        assert_eq!(Buckets::<char>::new(2, std::iter::empty()).list(1), []);
    }

    #[test]
    fn a_node_has_the_edges_that_end_there() {
        let around = Buckets::around(4, [[0, 1], [2, 1], [1, 0]].into_iter());
        let lists: Vec<&[u32]> = around.lists().collect();
        assert_eq!(lists, [&[0, 2][..], &[0, 1, 2], &[1], &[]]);
    }
}
